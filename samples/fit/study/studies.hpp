// The tables of samples/fit/constants.md, printed as Markdown.
#pragma once

namespace fit {

/// Errors of half-axes, exponents and tapers of known bodies, next to the stated standard errors.
void print_recovery(int bodies);

/// How often the truth is within one and two standard errors.
void print_coverage(int bodies);

/// Fits of unions of several bodies.
void print_unions();

/// Processor time of 100 000 points.
void print_time();

}  // namespace fit

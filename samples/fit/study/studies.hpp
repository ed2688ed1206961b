// The tables of samples/fit/README.md, printed as Markdown.
#pragma once

namespace fit {

/// Errors of half-axes, exponents and tapers of bodies that are known, beside the standard errors that the fits state.
void print_recovery(int bodies);

/// How often the truth lies within one and two standard errors.
void print_coverage(int bodies);

/// Unions of several bodies, and what the fits make of them.
void print_unions();

/// Processor time of 100 000 points.
void print_time();

}  // namespace fit

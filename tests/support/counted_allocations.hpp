// Counts allocations. A program that compiles counted_allocations.cpp replaces operator new for everything in it.
#pragma once

namespace supernormal::test {

/// How often operator new was called in this program.
long allocations();

}  // namespace supernormal::test

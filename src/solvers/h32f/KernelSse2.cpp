#define HYBRIDGV_INSTRUCTION_SET sse2
#include "solvers/h32f/KernelBody.hpp"

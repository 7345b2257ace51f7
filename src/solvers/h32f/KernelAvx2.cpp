#define HYBRIDGV_INSTRUCTION_SET avx2
#include "solvers/h32f/KernelBody.hpp"

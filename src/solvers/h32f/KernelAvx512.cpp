#define HYBRIDGV_INSTRUCTION_SET avx512
#include "solvers/h32f/KernelBody.hpp"

#define HYBRIDGV_INSTRUCTION_SET baseline
#include "solvers/h32f/KernelBody.hpp"

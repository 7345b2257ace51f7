/// \file
/// \brief Marks what the shared library exports; everything else is hidden.
#pragma once

/// \def HYBRIDGV_EXPORT
/// Before a class or function: it is part of the shared library's interface.

#if defined(_WIN32)
#if defined(HYBRIDGV_BUILDING_LIBRARY)
#define HYBRIDGV_EXPORT __declspec(dllexport)
#else
#define HYBRIDGV_EXPORT __declspec(dllimport)
#endif
#else
#define HYBRIDGV_EXPORT __attribute__((visibility("default")))
#endif

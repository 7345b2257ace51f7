/// \file
/// \brief Marks what the shared library exports; everything else is hidden.
#pragma once

/// \def HYBRIDGV_EXPORT
/// Before a class or function: it is part of the library's interface.
///
/// Where the library is linked statically, `HYBRIDGV_STATIC` is defined: programs on Windows need it. The CMake target and the
/// pkg-config file define it.

#if defined(_WIN32) && defined(HYBRIDGV_STATIC)
#define HYBRIDGV_EXPORT
#elif defined(_WIN32)
#if defined(HYBRIDGV_BUILDING_LIBRARY)
#define HYBRIDGV_EXPORT __declspec(dllexport)
#else
#define HYBRIDGV_EXPORT __declspec(dllimport)
#endif
#else
#define HYBRIDGV_EXPORT __attribute__((visibility("default")))
#endif

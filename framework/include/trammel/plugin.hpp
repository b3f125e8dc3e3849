// The macro at the end of a plugin's source, which exports its components.
//
//     namespace { struct HhtAlpha : trammel::Integrator { double alpha = -0.1; ... }; }
//
//     TRAMMEL_PLUGIN(trammel::integrator<HhtAlpha>("hht_alpha", "HHT-alpha with stabilised constraints")
//                        .parameter("alpha", &HhtAlpha::alpha, {.min = -1.0 / 3, .max = 0}))
//
// Use it once per library, outside any anonymous namespace. It exports a byte section and one C function:
//
//   .trammel               a magic line, then key=value lines: the properties that must agree in plugin and host before
//                          C++ objects may be exchanged, and the extensions of the processor that the code needs. The
//                          compiler's name is for information only: compilers agree on layouts, and on one another's
//                          standard library. The host reads the section from the file, so that no code of an
//                          incompatible library is executed. The section survives strip and --gc-sections. Its last
//                          line is reserved for a checksum of the library's code, written by trammel_add_plugin and
//                          `trammel seal`: a file that was damaged afterwards is refused before it is loaded. A library
//                          without a checksum is loaded without this check.
//   trammel_declarations   returns the declarations of the library's components; called once, after these checks.
#pragma once

#include <vector>

#include <trammel/parameters.hpp>

// Version of these headers. Major: a virtual function or a type's layout changed. Minor: abilities were added
// (CHANGES.md).
#define TRAMMEL_SDK_MAJOR 6
#define TRAMMEL_SDK_MINOR 1

namespace trammel {
using Declarations = std::vector<Declaration>;
}

#define TRAMMEL_TEXT_OF(x) #x
#define TRAMMEL_TEXT(x) TRAMMEL_TEXT_OF(x)

#if defined(__clang__)
#define TRAMMEL_COMPILER "clang " TRAMMEL_TEXT(__clang_major__)
#else
#define TRAMMEL_COMPILER "gcc " TRAMMEL_TEXT(__GNUC__)
#endif

#if defined(_LIBCPP_VERSION)
#define TRAMMEL_STANDARD_LIBRARY "libc++ " TRAMMEL_TEXT(_LIBCPP_VERSION)
#define TRAMMEL_STRING_ABI TRAMMEL_TEXT(_LIBCPP_ABI_VERSION)
#else
#define TRAMMEL_STANDARD_LIBRARY "libstdc++ " TRAMMEL_TEXT(_GLIBCXX_RELEASE)
#define TRAMMEL_STRING_ABI "cxx11=" TRAMMEL_TEXT(_GLIBCXX_USE_CXX11_ABI)
#endif

// Debug containers have a different layout.
#if defined(_GLIBCXX_DEBUG) || defined(_LIBCPP_ENABLE_DEBUG_MODE)
#define TRAMMEL_CONTAINERS "debug"
#else
#define TRAMMEL_CONTAINERS "plain"
#endif

// A sanitised library has the same layouts, but terminates an unsanitised program when it is loaded.
#if defined(__SANITIZE_ADDRESS__)
#define TRAMMEL_SANITIZER "address"
#elif defined(__SANITIZE_THREAD__)
#define TRAMMEL_SANITIZER "thread"
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define TRAMMEL_SANITIZER "address"
#elif __has_feature(thread_sanitizer)
#define TRAMMEL_SANITIZER "thread"
#endif
#endif
#if !defined(TRAMMEL_SANITIZER)
#define TRAMMEL_SANITIZER "none"
#endif

#if defined(EIGEN_DEFAULT_TO_ROW_MAJOR)
#define TRAMMEL_EIGEN_STORAGE "row-major"
#else
#define TRAMMEL_EIGEN_STORAGE "column-major"
#endif

// Extensions of the processor that the library's code may use: all those that compilers use by themselves and that a
// processor may lack. The names are those of __builtin_cpu_supports.
#if defined(__SSSE3__)
#define TRAMMEL_SSSE3 " ssse3"
#else
#define TRAMMEL_SSSE3 ""
#endif
#if defined(__SSE4_1__)
#define TRAMMEL_SSE4_1 " sse4.1"
#else
#define TRAMMEL_SSE4_1 ""
#endif
#if defined(__SSE4_2__)
#define TRAMMEL_SSE4_2 " sse4.2"
#else
#define TRAMMEL_SSE4_2 ""
#endif
#if defined(__POPCNT__)
#define TRAMMEL_POPCNT " popcnt"
#else
#define TRAMMEL_POPCNT ""
#endif
#if defined(__AVX__)
#define TRAMMEL_AVX " avx"
#else
#define TRAMMEL_AVX ""
#endif
#if defined(__AVX2__)
#define TRAMMEL_AVX2 " avx2"
#else
#define TRAMMEL_AVX2 ""
#endif
#if defined(__FMA__)
#define TRAMMEL_FMA " fma"
#else
#define TRAMMEL_FMA ""
#endif
#if defined(__BMI__)
#define TRAMMEL_BMI " bmi"
#else
#define TRAMMEL_BMI ""
#endif
#if defined(__BMI2__)
#define TRAMMEL_BMI2 " bmi2"
#else
#define TRAMMEL_BMI2 ""
#endif
#if defined(__AVX512F__)
#define TRAMMEL_AVX512F " avx512f"
#else
#define TRAMMEL_AVX512F ""
#endif
#if defined(__AVX512VL__)
#define TRAMMEL_AVX512VL " avx512vl"
#else
#define TRAMMEL_AVX512VL ""
#endif
#if defined(__AVX512DQ__)
#define TRAMMEL_AVX512DQ " avx512dq"
#else
#define TRAMMEL_AVX512DQ ""
#endif
#if defined(__AVX512BW__)
#define TRAMMEL_AVX512BW " avx512bw"
#else
#define TRAMMEL_AVX512BW ""
#endif
#if defined(__AVX512CD__)
#define TRAMMEL_AVX512CD " avx512cd"
#else
#define TRAMMEL_AVX512CD ""
#endif
#define TRAMMEL_EXTENSIONS                                                                                   \
  "base" TRAMMEL_SSSE3 TRAMMEL_SSE4_1 TRAMMEL_SSE4_2 TRAMMEL_POPCNT TRAMMEL_AVX TRAMMEL_AVX2 TRAMMEL_FMA     \
      TRAMMEL_BMI TRAMMEL_BMI2 TRAMMEL_AVX512F TRAMMEL_AVX512VL TRAMMEL_AVX512DQ TRAMMEL_AVX512BW TRAMMEL_AVX512CD

#define TRAMMEL_MAGIC "trammel plugin"

// eigen_align and eigen_malloc determine how a heap vector is allocated; it must be freed in the same way.
#define TRAMMEL_FINGERPRINT \
  TRAMMEL_MAGIC             \
  "\nsdk=" TRAMMEL_TEXT(TRAMMEL_SDK_MAJOR) "." TRAMMEL_TEXT(TRAMMEL_SDK_MINOR)                                       \
  "\ncompiler=" TRAMMEL_COMPILER                                                                                     \
  "\nextensions=" TRAMMEL_EXTENSIONS                                                                                 \
  "\nstandard_library=" TRAMMEL_STANDARD_LIBRARY                                                                     \
  "\nstring_abi=" TRAMMEL_STRING_ABI                                                                                 \
  "\ncontainers=" TRAMMEL_CONTAINERS                                                                                 \
  "\nsanitizer=" TRAMMEL_SANITIZER                                                                                   \
  "\neigen=" TRAMMEL_TEXT(EIGEN_WORLD_VERSION) "." TRAMMEL_TEXT(EIGEN_MAJOR_VERSION) "." TRAMMEL_TEXT(EIGEN_MINOR_VERSION) \
  "\neigen_align=" TRAMMEL_TEXT(EIGEN_MAX_ALIGN_BYTES)                                                               \
  "\neigen_static_align=" TRAMMEL_TEXT(EIGEN_MAX_STATIC_ALIGN_BYTES)                                                 \
  "\neigen_malloc=" TRAMMEL_TEXT(EIGEN_MALLOC_ALREADY_ALIGNED)                                                       \
  "\neigen_index=" TRAMMEL_TEXT(EIGEN_DEFAULT_DENSE_INDEX_TYPE)                                                      \
  "\neigen_storage=" TRAMMEL_EIGEN_STORAGE "\n"

#define TRAMMEL_UNSEALED "code=----------------\n"

#define TRAMMEL_PLUGIN(...)                                                                                    \
  [[gnu::section(".trammel"), gnu::used, gnu::retain]] static const char trammel_fingerprint[] =               \
      TRAMMEL_FINGERPRINT TRAMMEL_UNSEALED;                                                                    \
  extern "C" [[gnu::visibility("default"), gnu::used]] const ::trammel::Declarations* trammel_declarations() { \
    static const ::trammel::Declarations declarations{__VA_ARGS__};                                            \
    return &declarations;                                                                                      \
  }

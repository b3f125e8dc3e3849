// What a plugin's source ends with: the one macro that exports its components.
//
//     namespace { struct HhtAlpha : trammel::Integrator { double alpha = -0.1; ... }; }
//
//     TRAMMEL_PLUGIN(trammel::integrator<HhtAlpha>("hht_alpha", "HHT-alpha with stabilised constraints")
//                        .parameter("alpha", &HhtAlpha::alpha, {.min = -1.0 / 3, .max = 0}))
//
// Use it once per library, outside any anonymous namespace. It exports a byte section and one C function:
//
//   .trammel               magic line, then key=value lines: everything that must be equal in plugin and host before a
//   C++
//                          object crosses between them. The host reads it from the file, so nothing of a library that
//                          does not fit is ever run. It survives strip and --gc-sections. Its last line has room for a checksum
//                          of the library's code, which trammel_add_plugin and `trammel seal` write: a file that was damaged
//                          afterwards is refused before it is loaded. Without one it is not compared.
//   trammel_declarations   the declarations of the library's components; called once, after the comparison.
#pragma once

#include <vector>

#include <trammel/parameters.hpp>

// The SDK that these headers are. Major: a virtual function or a type's layout changed; minor: abilities were added (CHANGES.md).
#define TRAMMEL_SDK_MAJOR 3
#define TRAMMEL_SDK_MINOR 0

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

// Debug containers have other layouts.
#if defined(_GLIBCXX_DEBUG) || defined(_LIBCPP_ENABLE_DEBUG_MODE)
#define TRAMMEL_CONTAINERS "debug"
#else
#define TRAMMEL_CONTAINERS "plain"
#endif

// Layouts are the same, but a sanitised library ends an unsanitised program as soon as it is loaded.
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

#define TRAMMEL_MAGIC "trammel plugin"

// eigen_align and eigen_malloc say how a heap vector is allocated, which whoever frees it must know.
#define TRAMMEL_FINGERPRINT \
  TRAMMEL_MAGIC             \
  "\nsdk=" TRAMMEL_TEXT(TRAMMEL_SDK_MAJOR) "." TRAMMEL_TEXT(TRAMMEL_SDK_MINOR)                                       \
  "\ncompiler=" TRAMMEL_COMPILER                                                                                     \
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

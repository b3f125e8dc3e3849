// The loader has written the addresses of the functions that a library calls into its tables (R_X86_64_JUMP_SLOT,
// R_X86_64_GLOB_DAT of the System V ABI). Here those of malloc and related functions are replaced by functions that
// count.
#include "testing/kit/allocation_count.hpp"

#include <elf.h>
#include <link.h>
#include <sys/mman.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <cstring>
#include <new>
#include <string_view>

namespace trammel::kit {

namespace {

std::atomic<long long> count = 0;

void* counting_malloc(std::size_t size) {
  ++count;
  return std::malloc(size);
}
void* counting_calloc(std::size_t n, std::size_t size) {
  ++count;
  return std::calloc(n, size);
}
void* counting_realloc(void* block, std::size_t size) {
  ++count;
  return std::realloc(block, size);
}
void* counting_aligned_alloc(std::size_t alignment, std::size_t size) {
  ++count;
  return std::aligned_alloc(alignment, size);
}
int counting_posix_memalign(void** block, std::size_t alignment, std::size_t size) {
  ++count;
  return ::posix_memalign(block, alignment, size);
}
void* counting_new(std::size_t size) {
  ++count;
  return ::operator new(size);
}
void* counting_new_array(std::size_t size) {
  ++count;
  return ::operator new[](size);
}

void* counting(std::string_view name) {
  if (name == "malloc") return reinterpret_cast<void*>(&counting_malloc);
  if (name == "calloc") return reinterpret_cast<void*>(&counting_calloc);
  if (name == "realloc") return reinterpret_cast<void*>(&counting_realloc);
  if (name == "aligned_alloc") return reinterpret_cast<void*>(&counting_aligned_alloc);
  if (name == "posix_memalign") return reinterpret_cast<void*>(&counting_posix_memalign);
  if (name == "_Znwm") return reinterpret_cast<void*>(&counting_new);
  if (name == "_Znam") return reinterpret_cast<void*>(&counting_new_array);
  return nullptr;
}

#if defined(__x86_64__)

// Contents of the dynamic section about a library's relocations.
struct Tables {
  const ElfW(Sym) * symbols = nullptr;
  const char* names = nullptr;
  const ElfW(Rela) * by_call = nullptr;
  const ElfW(Rela) * by_data = nullptr;
  std::size_t calls = 0, data = 0;

  explicit Tables(const ElfW(Dyn) * d) {
    for (; d->d_tag != DT_NULL; ++d) switch (d->d_tag) {
        case DT_SYMTAB:
          symbols = reinterpret_cast<const ElfW(Sym)*>(d->d_un.d_ptr);
          break;
        case DT_STRTAB:
          names = reinterpret_cast<const char*>(d->d_un.d_ptr);
          break;
        case DT_JMPREL:
          by_call = reinterpret_cast<const ElfW(Rela)*>(d->d_un.d_ptr);
          break;
        case DT_PLTRELSZ:
          calls = d->d_un.d_val / sizeof(ElfW(Rela));
          break;
        case DT_RELA:
          by_data = reinterpret_cast<const ElfW(Rela)*>(d->d_un.d_ptr);
          break;
        case DT_RELASZ:
          data = d->d_un.d_val / sizeof(ElfW(Rela));
          break;
        default:
          break;
      }
  }
};

void replace(ElfW(Addr) slot, void* function) {
  const auto page = std::size_t(::sysconf(_SC_PAGESIZE));
  void* const start = reinterpret_cast<void*>(slot & ~(page - 1));
  // The tables are read-only once the loader has filled them (RELRO).
  if (::mprotect(start, page, PROT_READ | PROT_WRITE) != 0) return;
  *reinterpret_cast<void**>(slot) = function;
}

void count_in(const link_map& library) {
  const Tables t(library.l_ld);
  if (!t.symbols || !t.names) return;
  const auto look = [&](const ElfW(Rela) * relocation, std::size_t n) {
    for (std::size_t i = 0; relocation && i < n; ++i) {
      const auto type = ELF64_R_TYPE(relocation[i].r_info);
      if (type != R_X86_64_JUMP_SLOT && type != R_X86_64_GLOB_DAT) continue;
      const char* name = t.names + t.symbols[ELF64_R_SYM(relocation[i].r_info)].st_name;
      if (void* function = counting(name)) replace(library.l_addr + relocation[i].r_offset, function);
    }
  };
  look(t.by_call, t.calls);
  look(t.by_data, t.data);
}

#endif

}  // namespace

bool count_allocations_of([[maybe_unused]] const std::string& file) {
#if defined(__x86_64__)
  bool found = false;
  for (const link_map* l = _r_debug.r_map; l; l = l->l_next) {
    const std::string_view name = l->l_name;
    const bool ours = name.find("/libtrammel.so") != name.npos;
    if (name != file && !ours) continue;
    count_in(*l);
    found = found || name == file;
  }
  return found;
#else
  return false;
#endif
}

long long allocations() {
  return count;
}

}  // namespace trammel::kit

#include "plugin/library_section.hpp"

#include <elf.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <vector>

#include "plugin/plugin_error.hpp"
#include "scene/fnv_hash.hpp"
#include "scene/no_memory.hpp"

namespace trammel::plugin {

namespace {

constexpr std::uint64_t longest_section = 1 << 20;  // our section has a few hundred bytes

#if defined(__x86_64__)
constexpr Elf64_Half this_machine = EM_X86_64;
#elif defined(__aarch64__)
constexpr Elf64_Half this_machine = EM_AARCH64;
#else
#error "name this processor's ELF machine number"
#endif

class LibraryFile {
 public:
  explicit LibraryFile(const std::filesystem::path& file) : file_(file) {
    std::error_code error;
    const auto status = std::filesystem::status(file, error);
    if (!std::filesystem::exists(status)) refuse("no such file");
    if (std::filesystem::is_directory(status)) refuse("it is a folder, not a shared library");
    if (!std::filesystem::is_regular_file(status)) refuse("it is not a regular file");
    stream_.open(file, std::ios::binary);
    if (!stream_) {
      scene::require_memory(errno);
      refuse(fmt::format("cannot be read: {}", std::strerror(errno)));
    }
    size_ = std::filesystem::file_size(file, error);
    if (error) refuse(fmt::format("cannot be read: {}", error.message()));
    check_header();
    segments_ = table<Elf64_Phdr>(header_.e_phoff, header_.e_phnum, header_.e_phentsize, "program headers");
    read_sections();
    for (const Elf64_Phdr& segment : segments_) require_inside(segment.p_offset, segment.p_filesz, "a segment");
    for (const Elf64_Shdr& section : sections_)
      if (section.sh_type != SHT_NOBITS && section.sh_type != SHT_NULL)
        require_inside(section.sh_offset, section.sh_size, "a section");
  }

  const Elf64_Shdr* find(const std::string& name) {
    const std::string names = section_names();
    for (const Elf64_Shdr& section : sections_)
      if (section.sh_type == SHT_PROGBITS && name == name_in(names, section)) return &section;
    return nullptr;
  }

  std::string bytes(const Elf64_Shdr& section) {
    if (section.sh_size > longest_section) refuse(fmt::format("damaged: a section of {} bytes", section.sh_size));
    std::string content(section.sh_size, '\0');
    read(section.sh_offset, content.data(), content.size());
    return content;
  }

  std::uint64_t checksum(const std::string& except) {
    const std::string names = section_names();
    scene::FnvHash hash;
    for (const Elf64_Shdr& section : sections_) {
      const char* name = name_in(names, section);
      if (!is_checked(section) || name == except) continue;
      hash.text(name), hash.number(section.sh_addr), hash.number(section.sh_size);
      add_bytes(section, hash);
    }
    return hash.value();
  }

 private:
  // Excluded: search paths, which are in the dynamic section and its strings, and notes, which only describe the build.
  static bool is_checked(const Elf64_Shdr& section) {
    if (!(section.sh_flags & SHF_ALLOC)) return false;
    return section.sh_type != SHT_NOBITS && section.sh_type != SHT_DYNAMIC && section.sh_type != SHT_STRTAB &&
           section.sh_type != SHT_NOTE;
  }

  std::string section_names() {
    return header_.e_shstrndx < sections_.size() ? bytes(sections_[header_.e_shstrndx]) : std::string();
  }
  static const char* name_in(const std::string& names, const Elf64_Shdr& section) {
    return section.sh_name < names.size() ? names.c_str() + section.sh_name : "";
  }

  void add_bytes(const Elf64_Shdr& section, scene::FnvHash& hash) {
    std::array<char, 1 << 14> block;
    for (std::uint64_t done = 0; done < section.sh_size; done += block.size()) {
      const std::size_t size = std::min<std::uint64_t>(block.size(), section.sh_size - done);
      read(section.sh_offset + done, block.data(), size);
      hash.bytes(block.data(), size);
    }
  }

  [[noreturn]] void refuse(const std::string& cause) const { throw PluginError(file_.string(), cause); }

  void check_header() {
    if (size_ < sizeof header_) refuse(fmt::format("not a shared library: it has {} bytes", size_));
    read(0, &header_, sizeof header_);
    const unsigned char* id = header_.e_ident;
    if (std::memcmp(id, ELFMAG, SELFMAG) != 0) refuse("not a shared library: it is no ELF file");
    if (id[EI_CLASS] != ELFCLASS64 || id[EI_DATA] != ELFDATA2LSB || header_.e_machine != this_machine)
      refuse(fmt::format("built for another processor: ELF machine {}, this program has {}", header_.e_machine,
                         this_machine));
    if (header_.e_type != ET_DYN) refuse("not a shared library: build it with -shared -fPIC, or as a CMake MODULE");
  }

  void read_sections() {
    if (header_.e_shoff == 0) return;
    std::uint64_t count = header_.e_shnum;
    if (count == 0) {  // does not fit in 16 bits: the first section header has the number
      const auto first = table<Elf64_Shdr>(header_.e_shoff, 1, header_.e_shentsize, "section headers");
      count = first.front().sh_size;
    }
    sections_ = table<Elf64_Shdr>(header_.e_shoff, count, header_.e_shentsize, "section headers");
  }

  // Compared by subtraction, because a sum of two 64-bit numbers of a hostile file may overflow.
  void require_inside(std::uint64_t offset, std::uint64_t size, const char* what) const {
    if (size > size_ || offset > size_ - size)
      refuse(fmt::format("truncated: {} should reach to byte {}, the file has {}", what, offset + size, size_));
  }

  template <class Header>
  std::vector<Header> table(std::uint64_t offset, std::uint64_t count, std::uint64_t entry_size, const char* what) {
    if (count == 0) return {};
    if (entry_size != sizeof(Header)) refuse(fmt::format("damaged: its {} have entries of {} bytes", what, entry_size));
    if (count > size_ / sizeof(Header)) refuse(fmt::format("truncated: its {} do not fit in {} bytes", what, size_));
    require_inside(offset, count * sizeof(Header), what);
    std::vector<Header> headers(count);
    read(offset, headers.data(), count * sizeof(Header));
    return headers;
  }

  void read(std::uint64_t offset, void* to, std::size_t size) {
    stream_.seekg(static_cast<std::streamoff>(offset));
    stream_.read(static_cast<char*>(to), static_cast<std::streamsize>(size));
    if (!stream_) refuse(fmt::format("cannot be read at byte {}", offset));
  }

  std::filesystem::path file_;
  std::ifstream stream_;
  std::uint64_t size_ = 0;
  Elf64_Ehdr header_{};
  std::vector<Elf64_Phdr> segments_;
  std::vector<Elf64_Shdr> sections_;
};

}  // namespace

std::optional<std::string> library_section(const std::filesystem::path& file, const std::string& name) {
  LibraryFile library(file);
  const Elf64_Shdr* section = library.find(name);
  return section ? std::optional(library.bytes(*section)) : std::nullopt;
}

std::optional<std::uint64_t> library_section_offset(const std::filesystem::path& file, const std::string& name) {
  LibraryFile library(file);
  const Elf64_Shdr* section = library.find(name);
  return section ? std::optional(section->sh_offset) : std::nullopt;
}

std::uint64_t library_checksum(const std::filesystem::path& file, const std::string& except) {
  return LibraryFile(file).checksum(except);
}

}  // namespace trammel::plugin

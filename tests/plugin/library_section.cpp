#include "plugin/library_section.hpp"

#include <elf.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "plugin/fingerprint.hpp"
#include "plugin/plugin_error.hpp"
#include "test_library.hpp"

namespace trammel::plugin {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

// What library_section refuses; "" if it does not.
std::string refusal(const std::filesystem::path& file) {
  try {
    library_section(file, ".trammel");
    return "";
  } catch (const PluginError& e) {
    EXPECT_THAT(e.what(), HasSubstr(file.string()));
    return e.cause();
  }
}

TEST(LibrarySection, IsReadFromTheFile) {
  EXPECT_THAT(library_section(library("good"), ".trammel").value_or(""), StartsWith(host_fingerprint()));
}

TEST(LibrarySection, SurvivesStripAndSectionCollection) {
  EXPECT_THAT(library_section(library("stripped"), ".trammel").value_or(""), StartsWith(host_fingerprint()));
}

TEST(LibrarySection, IsMissingInAnOrdinaryLibrary) {
  EXPECT_EQ(library_section(library("not_a_plugin"), ".trammel"), std::nullopt);
}

TEST(LibrarySection, RefusesALibraryTruncatedAnywhere) {
  const Folder folder;
  const auto file = folder.copy("good", "cut.so");
  const std::uintmax_t whole = std::filesystem::file_size(file), step = std::max<std::uintmax_t>(1, whole / 400);
  for (std::uintmax_t length = whole - 1;; length -= length <= 256 ? 1 : std::min(step, length - 256)) {
    std::filesystem::resize_file(file, length);
    ASSERT_NE(refusal(file), "") << "cut to " << length << " of " << whole << " bytes";
    if (length == 0) break;
  }
}

TEST(LibrarySection, SaysThatATruncatedLibraryIsTruncated) {
  const Folder folder;
  const auto file = folder.copy("good", "cut.so");
  std::filesystem::resize_file(file, std::filesystem::file_size(file) - 1);
  EXPECT_THAT(refusal(file), StartsWith("truncated: "));
}

TEST(LibrarySection, NamesAMissingFile) {
  EXPECT_EQ(refusal(library("no_such_library")), "no such file");
}

TEST(LibrarySection, RefusesAFolder) {
  EXPECT_THAT(refusal("/tmp"), HasSubstr("folder"));
}

TEST(LibrarySection, RefusesADevice) {
  EXPECT_EQ(refusal("/dev/zero"), "it is not a regular file");
}

TEST(LibrarySection, RefusesText) {
  const Folder folder;
  write(folder / "text.so", std::string(1000, 'x'));
  EXPECT_EQ(refusal(folder / "text.so"), "not a shared library: it is no ELF file");
}

TEST(LibrarySection, RefusesAnObjectOfAnotherProcessor) {
  const Folder folder;
  std::string bytes = content(library("good"));
  bytes[offsetof(Elf64_Ehdr, e_machine)] = EM_SPARC;
  write(folder / "sparc.so", bytes);
  EXPECT_THAT(refusal(folder / "sparc.so"), StartsWith("built for another processor: ELF machine 2, "));
}

TEST(LibrarySection, RefusesOffsetsThatOverflow) {
  const Folder folder;
  std::string bytes = content(library("good"));
  const Elf64_Off huge = ~Elf64_Off{0} - 8;
  std::memcpy(bytes.data() + offsetof(Elf64_Ehdr, e_shoff), &huge, sizeof huge);
  write(folder / "huge.so", bytes);
  EXPECT_THAT(refusal(folder / "huge.so"), HasSubstr("truncated"));
}

// Bytes of the headers changed one by one: an answer or a refusal, never a crash.
TEST(LibrarySection, SurvivesDamagedHeaders) {
  const Folder folder;
  const auto file = folder.copy("good", "damaged.so");
  const std::string whole = content(file);
  std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
  const auto put = [&](std::size_t i, char value) {
    stream.seekp(static_cast<std::streamoff>(i)).put(value).flush();
    ASSERT_TRUE(stream.good());
  };
  for (std::size_t i = 0; i < sizeof(Elf64_Ehdr) + 4 * sizeof(Elf64_Phdr); ++i) {
    for (const char value : {'\x00', '\x7f', '\xff'}) {
      put(i, value);
      try {
        library_section(file, ".trammel");
      } catch (const PluginError& e) {
        EXPECT_NE(e.cause(), "");
      }
    }
    put(i, whole[i]);
  }
  EXPECT_EQ(content(file), whole);
}

}  // namespace
}  // namespace trammel::plugin

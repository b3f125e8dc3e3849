#include "plugin/seal.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

#include "plugin/library_section.hpp"
#include "plugin/plugin_error.hpp"
#include "plugin/registry.hpp"
#include "test_library.hpp"

namespace trammel::plugin {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// Why the file is refused before anything of it is loaded; "" if it is not.
std::string refusal(const fs::path& file) {
  try {
    const auto section = library_section(file, ".trammel");
    if (!section) return "no section";
    require_seal(file, *section);
    return "";
  } catch (const PluginError& e) {
    return e.cause();
  }
}

void flip(const fs::path& file, std::size_t byte, int bit) {
  std::string bytes = content(file);
  bytes[byte] = char(bytes[byte] ^ (1 << bit));
  write(file, bytes);
}

class Seal : public testing::Test {
 protected:
  void SetUp() override { seal(sealed); }
  const Folder folder;
  const fs::path sealed = folder.copy("good", "sealed.so");
};

TEST_F(Seal, FitsTheLibraryItWasMadeFor) {
  EXPECT_EQ(refusal(sealed), "");
  Registry registry(Registry::Start::empty);
  registry.load(sealed);
  EXPECT_EQ(registry.find(Kind::integrator, "good").declaration.name, "good");
}

TEST_F(Seal, IsNotAskedOfALibraryThatHasNone) {
  EXPECT_THAT(content(library("good")), HasSubstr("code=----------------"));
  EXPECT_EQ(refusal(library("good")), "");
}

TEST_F(Seal, IsTheSameWhenItIsWrittenAgain) {
  const std::string once = content(sealed);
  seal(sealed);
  EXPECT_EQ(content(sealed), once);
}

// Each bit of code, constants and data that may be damaged is seen: FNV-1a never maps two texts that differ in one byte
// to one sum.
TEST_F(Seal, BreaksWithAnyBitOfTheCode) {
  const std::string whole = content(sealed);
  const std::uint64_t code = *library_section_offset(sealed, ".text"),
                      constants = *library_section_offset(sealed, ".rodata");
  const std::size_t code_size = library_section(sealed, ".text")->size();
  const std::size_t constants_size = library_section(sealed, ".rodata")->size();
  std::mt19937 random(1);
  for (int i = 0; i < 200; ++i) {
    const std::size_t at = i % 2 ? code + random() % code_size : constants + random() % constants_size;
    flip(sealed, at, int(random() % 8));
    EXPECT_THAT(refusal(sealed), HasSubstr("damaged: its code has the checksum")) << "byte " << at;
    write(sealed, whole);
  }
}

// Damage anywhere, in headers, tables and names too, ends in an error or in a library that fits, never in a crash.
TEST_F(Seal, AndPreflightBearDamageAnywhere) {
  const std::string whole = content(sealed);
  std::mt19937 random(2);
  int refused = 0;
  for (int i = 0; i < 600; ++i) {
    const bool in_header = i % 3 == 0;
    flip(sealed, random() % (in_header ? 0x200 : whole.size()), int(random() % 8));
    refused += !refusal(sealed).empty();
    write(sealed, whole);
  }
  EXPECT_GT(refused, 100);
}

TEST_F(Seal, SurvivesStrip) {
  const std::size_t size = content(sealed).size();
  // strip is part of binutils, as the compiler's assembler.
  ASSERT_EQ(std::system(("strip --strip-all " + sealed.string()).c_str()), 0);
  EXPECT_LT(content(sealed).size(), size);
  EXPECT_EQ(refusal(sealed), "");
}

TEST_F(Seal, IsWrittenToPluginsOnly) {
  const fs::path other = folder.copy("not_a_plugin", "other.so");
  EXPECT_THROW(seal(other), PluginError);
}

}  // namespace
}  // namespace trammel::plugin

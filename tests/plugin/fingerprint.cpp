#include "plugin/fingerprint.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trammel::plugin {
namespace {

using testing::HasSubstr;

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  return text.replace(text.find(what), what.size(), with);
}

const std::string host = "trammel plugin\nsdk=2.3\ncompiler=gcc 12\neigen=3.4.0\neigen_align=64\n";

TEST(Fingerprint, OfThisProgramFitsItself) {
  EXPECT_EQ(mismatch(host_fingerprint(), host_fingerprint()), "");
}

TEST(Fingerprint, NamesWhatEigenAlignmentDependsOn) {
  EXPECT_THAT(std::string(host_fingerprint()), HasSubstr("\neigen_align=64\neigen_static_align=16\n"));
}

TEST(Fingerprint, NamesBothValuesOfADifference) {
  EXPECT_EQ(mismatch(replaced(host, "eigen_align=64", "eigen_align=32"), host),
            "eigen_align: the plugin has 32, this program 64");
}

TEST(Fingerprint, NamesEveryDifference) {
  const std::string plugin = replaced(replaced(host, "align=64", "align=32"), "3.4.0", "3.3.9");
  EXPECT_EQ(mismatch(plugin, host),
            "eigen: the plugin has 3.3.9, this program 3.4.0; eigen_align: the plugin has 32, this program 64");
}

TEST(Fingerprint, TakesAPluginOfAnotherCompilerWithTheSameStandardLibrary) {
  EXPECT_EQ(mismatch(replaced(host, "gcc 12", "clang 14"), host), "");
  const std::string with_library =
      replaced(host, "eigen=", "standard_library=libstdc++ 12\nstring_abi=cxx11=1\neigen=");
  EXPECT_EQ(mismatch(replaced(with_library, "++ 12", "++ 11"), with_library), "");
  EXPECT_EQ(mismatch(replaced(with_library, "libstdc++ 12", "libc++ 14000"), with_library),
            "standard_library: the plugin has libc++ 14000, this program libstdc++ 12");
  EXPECT_EQ(mismatch(replaced(with_library, "cxx11=1", "cxx11=0"), with_library),
            "string_abi: the plugin has cxx11=0, this program cxx11=1");
}

TEST(Fingerprint, TakesAPluginForOtherExtensionsOfTheProcessor) {
  const std::string with_avx = replaced(host, "eigen=", "extensions=base avx\neigen=");
  EXPECT_EQ(mismatch(replaced(with_avx, " avx", ""), with_avx), "");
  EXPECT_EQ(mismatch(host, with_avx), "");
}

TEST(Fingerprint, NamesWhatTheProcessorLacks) {
  EXPECT_EQ(missing_extensions(host_fingerprint()), "");
  EXPECT_EQ(missing_extensions(host), "");  // built before this line was there
  EXPECT_EQ(missing_extensions("trammel plugin\nextensions=base no_such_unit\n"),
            "its code needs no_such_unit, which this processor does not have; build it with -march=x86-64");
}

TEST(Fingerprint, TakesAPluginOfAnOlderMinorSdk) {
  EXPECT_EQ(mismatch(replaced(host, "2.3", "2.0"), host), "");
}

TEST(Fingerprint, RefusesAPluginOfANewerMinorSdk) {
  EXPECT_EQ(mismatch(replaced(host, "2.3", "2.4"), host), "sdk: the plugin has 2.4, this program 2.3");
}

TEST(Fingerprint, RefusesAPluginOfAnotherMajorSdk) {
  EXPECT_EQ(mismatch(replaced(host, "2.3", "1.3"), host), "sdk: the plugin has 1.3, this program 2.3");
}

TEST(Fingerprint, RefusesAnSdkThatIsNoVersion) {
  EXPECT_EQ(mismatch(replaced(host, "2.3", "two"), host), "sdk: the plugin has two, this program 2.3");
}

TEST(Fingerprint, RefusesAMissingLine) {
  EXPECT_EQ(mismatch(replaced(host, "eigen=3.4.0\n", ""), host), "eigen: the plugin has nothing, this program 3.4.0");
}

TEST(Fingerprint, RefusesOtherBytes) {
  EXPECT_THAT(mismatch(std::string("\x7f\0abc", 5), host), HasSubstr("does not start with"));
}

}  // namespace
}  // namespace trammel::plugin

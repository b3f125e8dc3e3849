#include "plugin/registry.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include <trammel/body.hpp>
#include <trammel/integrator.hpp>

#include "plugin/parameters.hpp"
#include "registry_of_test.hpp"
#include "test_library.hpp"

namespace trammel::plugin {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::string unknown(Registry& registry, Kind kind, const std::string& name) {
  try {
    registry.find(kind, name);
    return "";
  } catch (const UnknownComponent& e) {
    return e.what();
  }
}

// --- what it finds ---

TEST(Registry, FindsAComponentOfALoadedLibrary) {
  Registry registry = empty_registry();
  registry.load(library("good"));
  const Entry& entry = registry.find(Kind::integrator, "good");
  EXPECT_EQ(entry.declaration.summary, "explicit Euler");
  EXPECT_EQ(entry.file, std::filesystem::canonical(library("good")));
}

TEST(Registry, FindsEveryComponentOfALibrary) {
  Registry registry = empty_registry();
  registry.load(library("good"));
  EXPECT_EQ(registry.find(Kind::contact, "good_contact").declaration.kind, Kind::contact);
}

TEST(Registry, LoadsOnlyTheLibraryThatIsNamed) {
  const Folder folder;
  const auto good = folder.copy("good", "good.so");
  folder.copy("spoilt_step", "spoilt_step.so");
  Registry registry = empty_registry();
  registry.search(folder.path());
  EXPECT_THAT(registry.files(), IsEmpty());
  registry.find(Kind::integrator, "good");
  EXPECT_THAT(registry.files(), ElementsAre(std::filesystem::canonical(good)));
}

TEST(Registry, FindsAComponentInALibraryOfAnotherName) {
  const Folder folder;
  folder.copy("good", "collection.so");
  Registry registry = empty_registry();
  registry.search(folder.path());
  EXPECT_EQ(registry.find(Kind::contact, "good_contact").declaration.name, "good_contact");
}

TEST(Registry, SearchesTheEnvironmentsPath) {
  const Folder first, second;
  first.copy("good", "good.so");
  const auto file = second.copy("spoilt_force", "library_of_a_friend.so");
  ::setenv("TRAMMEL_PLUGIN_PATH", (first.path().string() + "::" + file.string()).c_str(), 1);
  Registry registry;
  ::unsetenv("TRAMMEL_PLUGIN_PATH");
  EXPECT_EQ(registry.find(Kind::integrator, "good").declaration.name, "good");
  EXPECT_EQ(registry.find(Kind::body, "spoilt_force").declaration.name, "spoilt_force");
}

TEST(Registry, SearchesTheScenesPluginsBesideTheSceneFile) {
  const Folder folder;
  folder.copy("good", "good.so");
  write(folder / "scene.json", R"({"plugins": ["good.so"]})");
  const scene::Scene scene = scene::Scene::load((folder / "scene.json").string());
  Registry registry = empty_registry();
  registry.allow_scene_plugins();
  scene::Problems problems;
  registry.search_scene(scene.root(), problems);
  EXPECT_TRUE(problems.empty());
  EXPECT_EQ(registry.find(Kind::integrator, "good").declaration.name, "good");
}

TEST(Registry, LoadsNothingThatASceneNamesWithoutConsent) {
  const Folder folder;
  folder.copy("good", "good.so");
  write(folder / "scene.json", R"({"plugins": ["good.so", "."]})");
  const scene::Scene scene = scene::Scene::load((folder / "scene.json").string());
  Registry registry = empty_registry();
  scene::Problems problems;
  registry.search_scene(scene.root(), problems);
  ASSERT_EQ(problems.errors().size(), 2u);
  EXPECT_THAT(problems.errors()[0].text(), HasSubstr("scene.json:1:14: plugins[0]: "));
  EXPECT_THAT(problems.errors()[0].text(), HasSubstr("--allow-scene-plugins"));
  EXPECT_TRUE(registry.files().empty());
}

TEST(Registry, TrustsAScenesPluginsInAFolderThatIsSearchedAndNoLinkOutOfIt) {
  const Folder trusted, stranger;
  trusted.copy("good", "good.so");
  const auto elsewhere = stranger.copy("spoilt_force", "spoilt_force.so");
  std::filesystem::create_symlink(elsewhere, trusted / "link.so");
  Registry registry = empty_registry();
  registry.search(trusted.path());
  scene::Problems problems;
  const auto naming = [&](const char* file) {
    return scene_of((R"({"plugins": [")" + (trusted / file).string() + R"("]})").c_str());
  };
  registry.search_scene(naming("good.so"), problems);
  EXPECT_TRUE(problems.empty());
  EXPECT_EQ(registry.files().size(), 1u);
  registry.search_scene(naming("link.so"), problems);
  EXPECT_EQ(problems.errors().size(), 1u);
  EXPECT_EQ(registry.files().size(), 1u);
}

TEST(Registry, SearchesTheUsersFolder) {
  const Folder data;
  std::filesystem::create_directories(data / "trammel/plugins");
  std::filesystem::copy_file(library("good"), data / "trammel/plugins/good.so");
  ::setenv("XDG_DATA_HOME", data.path().c_str(), 1);
  Registry registry;
  ::unsetenv("XDG_DATA_HOME");
  EXPECT_EQ(registry.find(Kind::integrator, "good").declaration.name, "good");
}

TEST(Registry, NeverSearchesTheCurrentFolder) {
  const Folder here;
  here.copy("good", "good.so");
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(here.path());
  ::setenv("XDG_DATA_HOME", "relative", 1);  // no absolute path is no path of the user's, and an empty entry no folder
  ::setenv("TRAMMEL_PLUGIN_PATH", ":", 1);
  std::filesystem::create_directories("relative/trammel/plugins");
  std::filesystem::copy_file("good.so", "relative/trammel/plugins/good.so");
  Registry registry;
  ::unsetenv("XDG_DATA_HOME"), ::unsetenv("TRAMMEL_PLUGIN_PATH");
  const std::string answer = unknown(registry, Kind::integrator, "good");
  std::filesystem::current_path(before);
  EXPECT_THAT(answer, HasSubstr("no integrator \"good\""));
}

// Which of two methods of one name has run must never be a matter of the order of folders.
TEST(Registry, RefusesOneNameInTwoFoldersOfTheSearchPath) {
  const Folder first, second;
  first.copy("good", "good.so"), second.copy("good", "good.so");
  Registry registry = empty_registry();
  registry.search(first.path()), registry.search(second.path());
  try {
    registry.find(Kind::integrator, "good");
    FAIL() << "took one of the two";
  } catch (const PluginError& e) {
    EXPECT_THAT(std::string(e.what()), HasSubstr(first.path().string()));
    EXPECT_THAT(std::string(e.what()), HasSubstr(second.path().string()));
  }
}

TEST(Registry, ReportsAMissingPluginOfTheSceneWhereItIsNamed) {
  Registry registry = empty_registry();
  scene::Problems problems;
  registry.search_scene(scene_of(R"({"plugins": ["no_such.so"]})"), problems);
  ASSERT_EQ(problems.errors().size(), 1u);
  EXPECT_THAT(problems.errors()[0].text(),
              HasSubstr("scene.json:1:14: plugins[0]: no such file or folder: no_such.so"));
}

TEST(Registry, ReportsPluginsThatAreNoArray) {
  Registry registry = empty_registry();
  scene::Problems problems;
  registry.search_scene(scene_of(R"({"plugins": "good.so"})"), problems);
  ASSERT_EQ(problems.errors().size(), 1u);
  EXPECT_THAT(problems.errors()[0].message, HasSubstr("expected an array"));
}

TEST(Registry, TakesTheSameFileTwice) {
  Registry registry = empty_registry();
  registry.load(library("good"));
  registry.load(library("good").parent_path() / "." / "good.so");
  EXPECT_EQ(registry.files().size(), 1u);
}

TEST(Registry, ListsByKindAndName) {
  Registry registry = empty_registry();
  registry.load(library("spoilt_step"));
  registry.load(library("good"));
  std::vector<std::string> names;
  for (const Entry* entry : registry.all()) names.push_back(entry->declaration.name);
  EXPECT_THAT(names, ElementsAre("good", "spoilt_step", "good_contact"));
}

TEST(Registry, ListsWhatWorksAndNamesWhatDoesNot) {
  const Folder folder;
  folder.copy("good", "good.so");
  folder.copy("other_abi", "other_abi.so");
  folder.copy("not_a_plugin", "libpng.so");  // other libraries may lie in the same folder
  write(folder / "cut.so", content(library("good")).substr(0, 1000));
  Registry registry = empty_registry();
  registry.search(folder.path());
  EXPECT_EQ(registry.all().size(), 2u);
  ASSERT_EQ(registry.failures().size(), 2u);
  EXPECT_THAT(registry.failures()[0].what(), HasSubstr("cut.so: truncated"));
  EXPECT_THAT(registry.failures()[1].what(), HasSubstr("other_abi.so: built for another program"));
}

// --- names it does not know ---

TEST(Registry, OffersTheNearestName) {
  Registry registry = empty_registry();
  registry.load(library("spoilt_step"));
  EXPECT_THAT(unknown(registry, Kind::integrator, "spoilt_steps"), HasSubstr("\"spoilt_step\"?"));
}

TEST(Registry, TellsTheKindANameReallyHas) {
  Registry registry = empty_registry();
  registry.load(library("good"));
  EXPECT_THAT(unknown(registry, Kind::body, "good"), HasSubstr("\"good\" is an integrator"));
}

TEST(Registry, SaysWhenNothingIsSearched) {
  Registry registry = empty_registry();
  EXPECT_THAT(unknown(registry, Kind::body, "rigid_body"), HasSubstr("--plugin"));
}

TEST(Registry, SaysWhichLibrariesItCouldNotSearch) {
  const Folder folder;
  folder.copy("other_abi", "mine.so");
  Registry registry = empty_registry();
  registry.search(folder.path());
  EXPECT_THAT(unknown(registry, Kind::integrator, "good"), HasSubstr("mine.so: built for another program"));
}

TEST(Registry, RefusesANameThatWouldLeaveTheFolder) {
  const Folder folder;
  Registry registry = empty_registry();
  registry.search(folder.path());
  EXPECT_THAT(unknown(registry, Kind::body, "../../tests/plugins/spoilt_force"), HasSubstr("no body"));
}

TEST(Registry, ReportsAnUnknownTypeWhereItStands) {
  Registry registry = empty_registry();
  registry.load(library("good"));
  scene::Problems problems;
  EXPECT_EQ(entry_of(registry, Kind::integrator, scene_of("{\n  \"type\": \"goood\"\n}"), problems), nullptr);
  ASSERT_EQ(problems.errors().size(), 1u);
  EXPECT_THAT(problems.errors()[0].text(), HasSubstr("scene.json:2:11: type: no integrator \"goood\""));
}

TEST(Registry, ReportsAnObjectWithoutType) {
  Registry registry = empty_registry();
  scene::Problems problems;
  EXPECT_EQ(entry_of(registry, Kind::body, scene_of("{}"), problems), nullptr);
  ASSERT_EQ(problems.errors().size(), 1u);
  EXPECT_THAT(problems.errors()[0].message, HasSubstr("\"type\" is missing"));
}

// --- across the boundary, with symbols hidden in the plugin ---

TEST(Boundary, AnAbilityIsFoundByDynamicCast) {
  Registry registry = empty_registry();
  registry.load(library("good"));
  const auto component = registry.find(Kind::integrator, "good").declaration.make();
  EXPECT_NE(dynamic_cast<Integrator*>(component.get()), nullptr);
  EXPECT_NE(dynamic_cast<DenseOutput*>(component.get()), nullptr);
  EXPECT_EQ(dynamic_cast<ErrorEstimate*>(component.get()), nullptr);
}

TEST(Boundary, AParameterErrorOfThePluginIsCaughtAsSuch) {
  Registry registry = empty_registry();
  registry.load(library("good"));
  scene::Problems problems;
  const scene::Value object = scene_of("{\n \"type\": \"good\", \"step\": 1,\n \"damping\": 0.25}");
  const Made<Integrator> made = make<Integrator>(registry, Kind::integrator, object, World{}, problems);
  EXPECT_EQ(made.component, nullptr);
  ASSERT_EQ(problems.errors().size(), 1u);
  EXPECT_EQ(problems.errors()[0].text(), "scene.json:3:13: damping: a quarter is not possible");
}

TEST(Boundary, AComponentOutlivesItsRegistry) {
  std::unique_ptr<Component> component;
  {
    Registry registry = empty_registry();
    registry.load(library("good"));
    component = registry.find(Kind::integrator, "good").declaration.make();
  }
  EXPECT_EQ(dynamic_cast<Integrator&>(*component).traits().order, 1);
}

}  // namespace
}  // namespace trammel::plugin

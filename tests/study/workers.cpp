#include "study/cases/workers.hpp"

#include <unistd.h>

#include <csignal>
#include <map>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

namespace trammel::study {
namespace {

std::vector<std::size_t> first(std::size_t n) {
  std::vector<std::size_t> tasks(n);
  std::iota(tasks.begin(), tasks.end(), 0);
  return tasks;
}

struct Answers {
  std::map<std::size_t, std::string> given;
  std::map<std::size_t, Lost> lost;
};

Answers run(std::size_t n, std::function<std::string(std::size_t)> work) {
  Answers all;
  Workers workers;
  workers.jobs = 2, workers.work = std::move(work);
  workers.answer = [&](std::size_t i, const std::string& text) { EXPECT_TRUE(all.given.emplace(i, text).second); };
  workers.lost = [&](const Lost& one) { EXPECT_TRUE(all.lost.emplace(one.task, one).second); };
  EXPECT_TRUE(workers.run(first(n)));
  return all;
}

TEST(Workers, AnswerEveryTaskOnce) {
  // Longer than a pipe holds, and empty ones.
  const Answers all = run(50, [](std::size_t i) { return std::string(i % 3 == 0 ? 0 : 100'000 + i, 'x'); });
  ASSERT_EQ(all.given.size(), 50u);
  for (const auto& [i, text] : all.given) EXPECT_EQ(text.size(), i % 3 == 0 ? 0 : 100'000 + i);
}

TEST(Workers, GoOnAfterTasksThatEndTheirProcess) {
  const Answers all = run(20, [](std::size_t i) -> std::string {
    if (i == 3) ::raise(SIGKILL);
    if (i == 7) ::_exit(9);
    return "done";
  });
  EXPECT_EQ(all.given.size(), 18u);
  ASSERT_EQ(all.lost.size(), 2u);
  EXPECT_TRUE(all.lost.at(3).outside);
  EXPECT_FALSE(all.lost.at(7).outside);
  EXPECT_EQ(all.lost.at(7).why, "its process ended with exit code 9, as if a plugin had called exit");
}

TEST(Workers, EndAtAnInterrupt) {
  simulate::Interrupt interrupt;
  std::size_t given = 0;
  Workers workers;
  workers.jobs = 2, workers.interrupt = &interrupt;
  workers.work = [](std::size_t) { return ::usleep(10'000), std::string("done"); };
  workers.answer = [&](std::size_t, const std::string&) {
    if (++given == 4) interrupt.request();
  };
  workers.lost = [](const Lost&) { ADD_FAILURE(); };
  EXPECT_FALSE(workers.run(first(1000)));
  EXPECT_LT(given, 100u);
}

}  // namespace
}  // namespace trammel::study

// A run cut after so many steps and resumed, again and again, through checkpoints as a file holds them.
#pragma once

#include <optional>

#include "run_scene.hpp"
#include "simulate/results/checkpoint.hpp"
#include "simulate/simulator.hpp"
#include "simulate/start/setup.hpp"

namespace trammel::test {

// One piece of a run: a fresh set-up, resumed from `data` if there is any, for so many steps.
struct Piece {
  bool ended = false;
  bool in_contact = false;
  long long steps = 0;
};

Piece run_piece(const scene::Scene& scene, const std::filesystem::path& folder, nlohmann::json& data,
                simulate::Recorder::Lengths& lengths, long long most_steps);

struct Logs {
  std::string series, events, fields;  // as the files; no fields were asked for: empty
  nlohmann::json data;
  long long steps = 0;
  int cuts_in_contact = 0;
};

// Cut after every `stride` steps.
Logs run_in_pieces(const scene::Scene& scene, long long stride);

}  // namespace trammel::test

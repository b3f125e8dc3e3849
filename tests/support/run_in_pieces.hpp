// Runs a scene in pieces: each is cut after a number of steps and resumed from its checkpoint as a file holds it.
#pragma once

#include <optional>

#include "run_scene.hpp"
#include "simulate/results/checkpoint.hpp"
#include "simulate/simulator.hpp"
#include "simulate/start/setup.hpp"

namespace trammel::test {

// One piece of a run: a fresh set-up, resumed from `data` unless that is empty, for `most_steps` steps at most.
struct Piece {
  bool ended = false;
  bool in_contact = false;
  long long steps = 0;
};

Piece run_piece(const scene::Scene& scene, const std::filesystem::path& folder, nlohmann::json& data,
                simulate::Recorder::Lengths& lengths, long long most_steps);

struct Logs {
  std::string series, events, fields;  // contents of the files; `fields` is empty if the scene records none
  nlohmann::json data;
  long long steps = 0;
  int cuts_in_contact = 0;
};

// Cuts the run after every `stride` steps.
Logs run_in_pieces(const scene::Scene& scene, long long stride);

}  // namespace trammel::test

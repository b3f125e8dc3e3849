// A homogeneous block of a planar scene that stands on the floor y = 0, its left side at x.
#pragma once

#include <nlohmann/json.hpp>

namespace trammel::test {

// Markers: its corners bl, br, tl, tr; left and right, the middles of its sides; centre.
inline nlohmann::json standing_block(double x, double width, double height, double mass) {
  const double w = width / 2, h = height / 2;
  return {{"type", "rigid_body"},
          {"mass", mass},
          {"inertia", mass * (width * width + height * height) / 12},
          {"position", {x + w, h}},
          {"markers",
           {{"bl", {-w, -h}},
            {"br", {w, -h}},
            {"tl", {-w, h}},
            {"tr", {w, h}},
            {"left", {-w, 0}},
            {"right", {w, 0}},
            {"centre", {0, 0}}}}};
}

}  // namespace trammel::test

// A correction that does nothing, for libraries whose fault lies elsewhere.
#pragma once

#include <trammel/correction.hpp>
#include <trammel/plugin.hpp>

struct Idle : trammel::Correction {
  bool corrects(Level) const override { return true; }
  trammel::Outcome apply(Level, trammel::System&, const Step&, trammel::State&) override {
    return trammel::Outcome::accept();
  }
};

// Bodies that refine: the shape, the energies, the momentum and the markers' motions stay.
#include <fmt/format.h>

#include <cmath>

#include <trammel/testing/archive.hpp>

#include "testing/body_under_test.hpp"
#include "testing/kit/components/components.hpp"

namespace trammel::kit {

namespace {

constexpr ClaimsOf refinement_claim{"body.refinement-", "trammel/body.hpp"};

std::string does_not_refine(const Subject& s) {
  return s.offers<Refinable>() ? "" : "it does not offer Refinable";
}

// A body before and after its first refinement, asked for by any contact.
struct Refined {
  std::unique_ptr<Body> coarse, fine;
  BodyAt before, after;
  std::unique_ptr<Transfer> transfer;

  Refined(const Subject& s, double size) : coarse(s.maker<Body>()()), fine(s.maker<Body>()()) {
    std::mt19937 random = s.random(51);
    const auto coordinates = coarse->coordinates();
    before = {0.3, Vec::Zero(coordinates.nq()), Vec::Zero(coordinates.nv())};
    coarse->initial(before.q, before.v);
    for (double& v : before.v) v += size * between(random, -1, 1);
    int iq = 0, iv = 0;
    for (const Coordinates::Part& part : coordinates.parts()) {
      Vec dq(part.nv), moved(part.nq);
      for (double& d : dq) d = size * between(random, -1, 1);
      model::retract(part, before.q.data() + iq, dq.data(), moved.data());
      before.q.segment(iq, part.nq) = moved;
      iq += part.nq, iv += part.nv;
    }
    auto& refinable = dynamic_cast<Refinable&>(*fine);
    static const char* const contacts[] = {"", "contact", "tip", "impact"};
    for (const char* contact : contacts) {
      RefineCause cause{.contact = contact, .at = {0.5, 0.5}};
      if (!refinable.due(before.t, before.q, before.v, cause)) continue;
      transfer = refinable.refine(before.t, before.q, before.v, cause);
      if (transfer) break;
    }
    if (!transfer) return;
    after = {before.t, Vec::Zero(fine->coordinates().nq()), Vec::Zero(fine->coordinates().nv())};
    transfer->q(before.q, after.q);
    transfer->v(before.v, after.v);
  }
  Motion marker(const Body& body, int i, const BodyAt& at) const {
    Motion m;
    body.motion(i, at.t, at.q, at.v, m);
    return m;
  }
};

// It may ask for another cause than those tried; then there is nothing to compare.
std::string never_due(const Subject& s) {
  const std::string no = does_not_refine(s);
  if (!no.empty()) return no;
  return Refined(s, 1e-3).transfer ? "" : "its parameters ask for no refinement; --with parameters that do";
}

Report keeps_its_energies(const Subject& s) {
  return compare("energies stay", [&](Comparison& c) {
    const Refined r(s, 1e-3);
    const Energy a = r.coarse->energy(r.before.t, r.before.q, r.before.v),
                 b = r.fine->energy(r.after.t, r.after.q, r.after.v);
    const double size = std::abs(a.kinetic) + std::abs(a.potential) + std::abs(a.elastic);
    // Sums over more elements: some thousand roundings, and differences of large strains.
    c.within(b.kinetic, a.kinetic, 1e-9 * (size + 1e-300), "kinetic energy");
    c.within(b.potential, a.potential, 1e-9 * (size + 1e-300), "potential energy");
    c.within(b.elastic, a.elastic, 1e-6 * (size + 1e-300), "elastic energy");
  });
}

Report keeps_its_momentum(const Subject& s) {
  return compare("mass and momentum stay", [&](Comparison& c) {
    const Refined r(s, 1e-3);
    const auto& a = dynamic_cast<const HasMomentum&>(*r.coarse);
    const auto& b = dynamic_cast<const HasMomentum&>(*r.fine);
    const Momentum p = a.momentum(r.before.t, r.before.q, r.before.v), n = b.momentum(r.after.t, r.after.q, r.after.v);
    c.within(n.mass, p.mass, 1e-12 * p.mass, "mass");
    c.within(Vec(n.linear), Vec(p.linear), 1e-9 * (p.linear.norm() + p.mass * 1e-3), "linear momentum");
    c.within(Vec(n.angular), Vec(p.angular), 1e-9 * (p.angular.norm() + p.mass * 1e-3), "angular momentum");
  });
}

Report keeps_its_markers(const Subject& s) {
  return compare("markers keep their names and motions", [&](Comparison& c) {
    const Refined r(s, 1e-3);
    c.holds(std::ranges::equal(r.coarse->markers(), r.fine->markers()), "the markers' names changed");
    for (int i = 0; i < int(r.coarse->markers().size()); ++i) {
      const Motion a = r.marker(*r.coarse, i, r.before), b = r.marker(*r.fine, i, r.after);
      const std::string name(r.coarse->markers()[std::size_t(i)]);
      c.within(Vec(b.x), Vec(a.x), 1e-10 * (1 + a.x.norm()), "position of " + name);
      c.within(Vec(b.V), Vec(a.V), 1e-9 * (1 + a.V.norm()), "velocity of " + name);
    }
  });
}

std::string tells_no_momentum(const Subject& s) {
  const std::string no = never_due(s);
  return !no.empty() || s.offers<HasMomentum>() ? no : "it does not offer HasMomentum";
}

Report becomes_larger(const Subject& s) {
  return compare("the refined body has more coordinates", [&](Comparison& c) {
    const Refined r(s, 1e-3);
    c.holds(r.after.v.size() > r.before.v.size(),
            fmt::format("{} coordinates before, {} after", r.before.v.size(), r.after.v.size()));
  });
}

Report resumes_refined(const Subject& s) {
  return compare("the archive rebuilds the refined body", [&](Comparison& c) {
    const Refined r(s, 1e-3);
    const auto again = s.maker<Body>()();
    MemoryArchive memory;
    dynamic_cast<Refinable&>(*r.fine).archive(memory);
    memory.reading = true;
    dynamic_cast<Refinable&>(*again).archive(memory);
    c.holds(again->coordinates().nv() == r.after.v.size(),
            fmt::format("{} coordinates, expected {}", again->coordinates().nv(), r.after.v.size()));
    if (again->coordinates().nv() != r.after.v.size()) return;
    Vec f = Vec::Zero(r.after.v.size()), g = f;
    r.fine->force(r.after.t, r.after.q, r.after.v, f);
    again->force(r.after.t, r.after.q, r.after.v, g);
    c.holds(same_bits(f, g), "its force differs");
  });
}

}  // namespace

Checks refinable_checks() {
  const char* const by_transfer = "The framework maps q and v by the transfer and solves for a and lambda again.";
  return {
      {refinement_claim("adds-coordinates", "A refined body has more coordinates.", "nv after > nv before",
                        "A body that may replace its coordinates during the run (mesh refinement)."),
       Level::quick, becomes_larger, never_due},
      {refinement_claim("keeps-the-energies", "A refinement changes no energy.", "T(q', v') = T(q, v), U(q') = U(q)",
                        by_transfer),
       Level::quick, keeps_its_energies, never_due},
      {refinement_claim("keeps-the-momentum", "A refinement changes no mass and no momentum.", "P(q', v') = P(q, v)",
                        "Mass and momentum, for the balance before and after a refinement."),
       Level::quick, keeps_its_momentum, tells_no_momentum},
      {refinement_claim("keeps-the-markers", "Markers keep their names, places and velocities.",
                        "x(q') = x(q), V(q', v') = V(q, v)",
                        "Markers keep their names and indices; Motion objects are created anew."),
       Level::quick, keeps_its_markers, never_due},
      {refinement_claim(
           "resumes", "The archive rebuilds the refined body.", "f(archive) = f",
           "The data that rebuild the refined coordinates when a run resumes; coordinates() is called after reading."),
       Level::quick, resumes_refined, never_due}};
}

}  // namespace trammel::kit

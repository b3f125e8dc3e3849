#include "support/run_in_pieces.hpp"

namespace trammel::test {

Piece run_piece(const scene::Scene& scene, const std::filesystem::path& folder, nlohmann::json& data,
                simulate::Recorder::Lengths& lengths, long long most_steps) {
  simulate::Setup setup = simulate::set_up(scene, registry());
  simulate::Simulator simulator(setup.model, *setup.integrator, setup.settings, {});
  std::optional<simulate::Recorder> recorder;
  if (data.is_null()) {
    recorder.emplace(folder, *setup.model, setup.columns, std::nullopt, setup.settings.field_times);
    simulator.start(setup.initial);
  } else {
    recorder.emplace(folder, *setup.model, setup.columns, lengths, setup.settings.field_times);
    simulate::JsonArchive archive(data, simulate::JsonArchive::Direction::read);
    simulator.archive(archive);
    simulator.resume();
  }
  Piece piece;
  while (most_steps-- > 0 && !piece.ended) piece.ended = !simulator.advance(*recorder);
  recorder->flush();
  lengths = recorder->lengths();
  data = nlohmann::json::object();
  simulate::JsonArchive archive(data, simulate::JsonArchive::Direction::write);
  simulator.archive(archive);
  data = nlohmann::json::from_cbor(nlohmann::json::to_cbor(data));  // as the file holds it
  piece.steps = simulator.statistics().steps;
  for (const auto& mode : simulator.system().modes().contacts) piece.in_contact = piece.in_contact || mode.closed;
  return piece;
}

Logs run_in_pieces(const scene::Scene& scene, long long stride) {
  const Folder folder;
  std::filesystem::create_directories(folder.path());
  Logs logs;
  simulate::Recorder::Lengths lengths;
  for (Piece piece; !piece.ended;) {
    piece = run_piece(scene, folder.path(), logs.data, lengths, stride);
    logs.steps = piece.steps;
    logs.cuts_in_contact += piece.in_contact;
  }
  for (const char* work : {"factorizations", "residual_evaluations"})
    logs.data.erase(work);  // the start of each piece adds some
  logs.series = read_text(folder.path() / "series.csv");
  logs.events = read_text(folder.path() / "events.csv");
  logs.fields = read_text(folder.path() / "fields.ndjson");
  return logs;
}

}  // namespace trammel::test

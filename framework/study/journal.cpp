#include "study/journal.hpp"

#include <fstream>
#include <sstream>

namespace trammel::study {
namespace {

std::string whole_lines(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string text((std::istreambuf_iterator<char>(in)), {});
  text.resize(text.rfind('\n') == text.npos ? 0 : text.rfind('\n') + 1);
  return text;
}

simulate::LogFile opened(const std::filesystem::path& file) {
  const std::string text = whole_lines(file);
  if (text.empty()) return simulate::LogFile(file);
  scene::FnvHash hash;
  hash.bytes(text.data(), text.size());
  return simulate::LogFile(file, {(long long)(text.size()), hash.value()});
}

}  // namespace

std::vector<CaseRecord> read_journal(const std::filesystem::path& folder) {
  std::vector<CaseRecord> all;
  std::istringstream in(whole_lines(folder / journal_name));
  for (std::string line; std::getline(in, line);)
    if (auto record = from_line(line)) all.push_back(std::move(*record));
  return all;
}

Journal::Journal(const std::filesystem::path& folder) : log_(opened(folder / journal_name)) {}

void Journal::add(const std::string& line) {
  log_.append(line);
  if (!log_.flush()) throw simulate::OutputError(log_.problem());
}

}  // namespace trammel::study

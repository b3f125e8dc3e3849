// VTK's XML files: animation.pvd and fields.pvd list one .vtu per time, in the folder vtu/.
//
//     animation   outlines of bodies as polylines and faces as quadrilaterals; cell data "body", the body's number;
//                 point data "values" of faces (NaN on outlines)
//     fields      at the times of "record": {"fields": [...]}: quadrilaterals between the points of each element, with
//                 all fields as point data
//
// VTK File Formats, XML; ASCII arrays.
#include <fstream>
#include <iterator>
#include <map>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "formats/run_formats.hpp"
#include "simulate/results/log_file.hpp"

namespace trammel::formats {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int polyline = 4, quadrilateral = 9, vertex = 1;  // vtkCellType

// Points, cells and data of one time.
class Grid {
 public:
  // z = 0 in planar scenes. Returns the point's index.
  long long point(const Json& place) {
    for (std::size_t i = 0; i < 3; ++i)
      fmt::format_to(std::back_inserter(points_), "{} ", i < place.size() ? place[i].get<double>() : 0.0);
    return n_points_++;
  }
  void cell(int type, const std::vector<long long>& of, int body) {
    for (const long long k : of) fmt::format_to(std::back_inserter(connectivity_), "{} ", k);
    fmt::format_to(std::back_inserter(offsets_), "{} ", end_ += (long long)(of.size()));
    fmt::format_to(std::back_inserter(types_), "{} ", type);
    fmt::format_to(std::back_inserter(bodies_), "{} ", body);
    ++n_cells_;
  }
  // Values of the last points added, one number each; earlier points that have no value yet get NaN.
  void values(const std::string& name, const Json& numbers) {
    Field& field = fields_[name];
    fill(field, n_points_ - (long long)(numbers.size()));
    for (const Json& x : numbers) {
      field.text += x.is_number() ? fmt::format("{} ", x.get<double>()) : "nan ";
      ++field.count;
    }
  }
  std::string xml() {
    std::string text =
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\">\n";
    text += fmt::format("<UnstructuredGrid><Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n", n_points_, n_cells_);
    text += "<Points>" + array("Float64", "", points_, 3) + "</Points>\n<Cells>";
    text += array("Int64", "connectivity", connectivity_) + array("Int64", "offsets", offsets_) +
            array("UInt8", "types", types_) + "</Cells>\n<PointData>";
    for (auto& [name, field] : fields_) {
      fill(field, n_points_);
      text += array("Float64", name, field.text);
    }
    return text + "</PointData>\n<CellData>" + array("Int32", "body", bodies_) +
           "</CellData>\n</Piece></UnstructuredGrid>\n</VTKFile>\n";
  }

 private:
  struct Field {
    std::string text;
    long long count = 0;
  };
  static void fill(Field& field, long long until) {
    for (; field.count < until; ++field.count) field.text += "nan ";
  }
  static std::string array(const char* type, const std::string& name, const std::string& content, int components = 1) {
    return fmt::format("<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"ascii\">{}</DataArray>\n",
                       type, name.empty() ? "Points" : name, components, content);
  }
  std::string points_, connectivity_, offsets_, types_, bodies_;
  std::map<std::string, Field> fields_;
  long long n_points_ = 0, n_cells_ = 0, end_ = 0;
};

void add_outline(Grid& grid, const Json& shape, int body) {
  std::vector<long long> points;
  for (const Json& place : shape) points.push_back(grid.point(place));
  grid.cell(points.size() == 1 ? vertex : polyline, points, body);
}

void add_faces(Grid& grid, const Json& faces, int body) {
  long long first = 0;
  for (std::size_t k = 0; k < faces.at("points").size(); ++k) {
    const long long at = grid.point(faces.at("points")[k]);
    if (k == 0) first = at;
  }
  for (const Json& quad : faces.at("quads")) {
    std::vector<long long> points;
    for (std::size_t k = 0; k < 4; ++k) points.push_back(first + quad[k].get<long long>());
    grid.cell(quadrilateral, points, body);
  }
  grid.values("values", faces.at("values"));
}

std::string animation_grid(const Json& line) {
  Grid grid;
  int body = 0;
  const Json faces = line.value("faces", Json::object()), shapes = line.value("shapes", Json::object());
  for (const auto& [name, shape] : shapes.items()) {
    if (const auto own = faces.find(name); own != faces.end())
      add_faces(grid, *own, body++);
    else
      add_outline(grid, shape, body++);
  }
  return grid.xml();
}

// The points of an element are given row by row, `along` points per row.
void add_patch(Grid& grid, const Json& patch, const Json& names, int body) {
  const auto along = patch.at("along").get<long long>();
  const auto count = (long long)(patch.at("points").size());
  long long first = 0;
  for (long long k = 0; k < count; ++k) {
    const long long at = grid.point(patch.at("points")[std::size_t(k)]);
    if (k == 0) first = at;
  }
  for (long long row = 0; row + 1 < count / along; ++row)
    for (long long k = 0; k + 1 < along; ++k) {
      const long long at = first + row * along + k;
      grid.cell(quadrilateral, {at, at + 1, at + along + 1, at + along}, body);
    }
  for (std::size_t f = 0; f < names.size(); ++f) grid.values(names[f], patch.at("values")[f]);
}

std::string fields_grid(const Json& line) {
  Grid grid;
  int body = 0;
  for (const auto& [name, fields] : line.at("bodies").items()) {
    for (const Json& patch : fields.at("patches")) add_patch(grid, patch, fields.at("fields"), body);
    ++body;
  }
  return grid.xml();
}

// A collection of one .vtu for each line of a log; false: the run has no such log.
bool write_collection(const fs::path& folder, const char* log, const char* name, std::string (*grid)(const Json&)) {
  std::ifstream in(folder / log);
  if (!in) return false;
  fs::create_directories(folder / "vtu");
  std::string list = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n", text;
  for (long long k = 0; std::getline(in, text); ++k) {
    const Json line = Json::parse(text, nullptr, false);
    if (line.is_discarded()) {
      if (in.eof()) break;  // cut off when the run was killed
      throw std::runtime_error(fmt::format("{}:{}: no JSON", (folder / log).string(), k + 1));
    }
    const std::string file = fmt::format("vtu/{}_{:06}.vtu", name, k);
    simulate::write_whole(folder / file, grid(line));
    list += fmt::format("<DataSet timestep=\"{}\" file=\"{}\"/>\n", line.at("t").get<double>(), file);
  }
  simulate::write_whole(folder / fmt::format("{}.pvd", name), list + "</Collection>\n</VTKFile>\n");
  return true;
}

}  // namespace

fs::path write_vtu(const fs::path& folder) {
  fs::remove_all(folder / "vtu");
  const bool fields = write_collection(folder, "fields.ndjson", "fields", fields_grid);
  const bool animation = write_collection(folder, "animation.ndjson", "animation", animation_grid);
  if (!fields && !animation) throw std::runtime_error("no body of this scene is drawn: there is nothing for VTK");
  return folder / (animation ? "animation.pvd" : "fields.pvd");
}

}  // namespace trammel::formats

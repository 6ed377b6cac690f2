// Pictures of hair, into arrays and files.
#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cstring>
#include <filesystem>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "python/devices.h"
#include "python/grooms.h"
#include "python/scenes.h"
#include "ringlet/output/animation_reader.h"
#include "ringlet/pictures/render_animation.h"

namespace ringlet::python {
namespace {

// What is drawn: strands at rest, or an animation.
using Source = std::variant<GroomHandle, std::filesystem::path>;

struct PictureAsked {
  const SceneObject* scene;
  std::optional<int> hairs;
  std::optional<double> width;
  std::pair<int, int> size;
  int samples;
  std::string colour, up;
  double azimuth, elevation, distance;
  bool showsBodies, showsGround;
  DeviceHandle device;
};

void demandBetween(const char* name, double value, double least, double most) {
  if (!(value >= least && value <= most))
    throw py::value_error(fmt::format("{} must be from {:g} to {:g}, got {:g}", name, least, most, value));
}

RenderPlan planOf(const PictureAsked& asked) {
  demandBetween("width of size", asked.size.first, 1, 16384);
  demandBetween("height of size", asked.size.second, 1, 16384);
  demandBetween("samples", asked.samples, 1, 4);
  demandBetween("elevation", asked.elevation, -89, 89);
  demandBetween("azimuth", asked.azimuth, -3600, 3600);
  demandBetween("distance", asked.distance, 0.05, 100);
  if (asked.hairs) demandBetween("hairs", *asked.hairs, 0, 1e7);
  if (asked.width) demandBetween("width", *asked.width, 1e-7, 0.1);
  if (asked.up != "Y" && asked.up != "Z") throw py::value_error(unknownName("axis", asked.up, {"Y", "Z"}));
  RenderPlan plan;
  plan.hair = {asked.hairs, asked.width, {}};
  plan.size = {asked.size.first, asked.size.second, asked.samples};
  const auto look = lookByName(asked.colour);
  if (!look)
    throw py::value_error(
        fmt::format("there is no hair colour '{}'; there are {}", asked.colour, hairColourNames()));
  plan.look = *look;
  const auto radians = [](double degrees) { return degrees * std::numbers::pi / 180; };
  plan.camera.place = {radians(asked.azimuth), radians(asked.elevation), asked.distance};
  plan.showsSolids = asked.showsBodies;
  if (asked.showsGround) plan.ground = Ground{};
  return plan;
}

// Draws as the plan says, with the scene's bodies and strands at rest.
RenderOutcome draw(const Source& source, const PictureAsked& asked, RenderPlan plan) {
  const auto drawn = [&]() -> RenderOutcome {
    GilReleased released;
    plan.isStopped = [&] { return released.isInterrupted(); };
    const ComputeDevice device = asked.device ? asked.device->device : valueOf(ComputeDevice::open());
    std::optional<LoadedScene> scene;
    if (asked.scene) {
      scene.emplace(asked.scene->whole());
      plan.scene = &*scene;
      plan.rest = &scene->groom;
    }
    if (const auto* groom = std::get_if<GroomHandle>(&source))
      return valueOf(renderGroom((*groom)->groom(), asked.up == "Z" ? UpAxis::z : UpAxis::y, device, plan));
    return valueOf(renderAnimation(std::get<std::filesystem::path>(source), device, plan));
  };
  RenderOutcome outcome = drawn();
  if (outcome.interrupted) throw py::error_already_set();
  return outcome;
}

py::array pictureOf(const Source& source, int frame, const PictureAsked& asked) {
  if (frame < 1) throw py::value_error(fmt::format("frame must be 1 or more, got {}", frame));
  RenderPlan plan = planOf(asked);
  plan.firstFrame = plan.lastFrame = frame;
  std::optional<Picture> taken;
  plan.target.take = [&](int, Picture picture) -> Status {
    taken.emplace(std::move(picture));
    return {};
  };
  draw(source, asked, std::move(plan));
  static_assert(sizeof(Colour) == 3);
  py::array_t<std::uint8_t> array({taken->height, taken->width, 3});
  std::memcpy(array.mutable_data(), taken->pixels.data(), taken->pixels.size() * sizeof(Colour));
  return array;
}

std::vector<std::filesystem::path> render(const Source& source, const std::filesystem::path& output,
                                          const std::optional<std::pair<int, int>>& frames,
                                          const PictureAsked& asked) {
  RenderPlan plan = planOf(asked);
  plan.target.path = output;
  if (frames) {
    if (frames->first < 1 || frames->second < frames->first)
      throw py::value_error(fmt::format("frames must be (first, last) with 1 <= first <= last, got ({}, {})",
                                        frames->first, frames->second));
    plan.firstFrame = frames->first, plan.lastFrame = frames->second;
  }
  return draw(source, asked, std::move(plan)).outputs;
}

constexpr const char* kLookHelp =
    "scene: the Scene it was simulated from: its bodies are shown, and hairs stand on its scalp. hairs: how "
    "many follow the strands; 0: the strands themselves; None: as many as look like hair. width: their "
    "diameter at the root [m]. size: (width, height) in pixels. samples: along a pixel's side, 1 to 4. "
    "colour: of hair. azimuth, elevation [degrees], distance [what just shows all]: of the camera. bodies: "
    "whether bodies are shown, or a head. ground: whether there is one. up: of a Groom, Y or Z. ringlet.Error "
    "for a file or device that fails, ValueError for a number out of its range.";

}  // namespace

void addPictures(py::module_& module) {
  static const std::string pictureHelp =
      std::string(
          "One picture of hair: (height, width, 3) uint8, sRGB. source: a Groom, or the path of an "
          "animation that Ringlet wrote. frame: of an animation, 1 the first. ") +
      kLookHelp;
  static const std::string renderHelp =
      std::string(
          "Pictures of hair in files; returns the paths of the first and the last. source: as of "
          "picture. output: a .png or .exr, a film (.mp4, .webm, .gif), or a folder for a picture a "
          "frame. frames: (first, last) of an animation; None: all. ") +
      kLookHelp;
  module.def(
      "picture",
      [](const Source& source, int frame, const SceneObject* scene, std::optional<int> hairs,
         std::optional<double> width, std::pair<int, int> size, int samples, std::string colour,
         double azimuth, double elevation, double distance, bool bodies, bool ground, std::string up,
         DeviceHandle device) {
        return pictureOf(source, frame,
                         {scene, hairs, width, size, samples, std::move(colour), std::move(up), azimuth,
                          elevation, distance, bodies, ground, std::move(device)});
      },
      py::arg("source"), py::kw_only(), py::arg("frame") = 1, py::arg("scene") = py::none(),
      py::arg("hairs") = py::none(), py::arg("width") = py::none(), py::arg("size") = std::pair(960, 540),
      py::arg("samples") = 4, py::arg("colour") = "auburn", py::arg("azimuth") = 35.0,
      py::arg("elevation") = 5.0, py::arg("distance") = 1.0, py::arg("bodies") = true,
      py::arg("ground") = false, py::arg("up") = "Y", py::arg("device") = py::none(), pictureHelp.c_str());
  module.def(
      "render",
      [](const Source& source, const std::filesystem::path& output,
         const std::optional<std::pair<int, int>>& frames, const SceneObject* scene, std::optional<int> hairs,
         std::optional<double> width, std::pair<int, int> size, int samples, std::string colour,
         double azimuth, double elevation, double distance, bool bodies, bool ground, std::string up,
         DeviceHandle device) {
        return render(source, output, frames,
                      {scene, hairs, width, size, samples, std::move(colour), std::move(up), azimuth,
                       elevation, distance, bodies, ground, std::move(device)});
      },
      py::arg("source"), py::arg("output"), py::kw_only(), py::arg("frames") = py::none(),
      py::arg("scene") = py::none(), py::arg("hairs") = py::none(), py::arg("width") = py::none(),
      py::arg("size") = std::pair(960, 540), py::arg("samples") = 4, py::arg("colour") = "auburn",
      py::arg("azimuth") = 35.0, py::arg("elevation") = 5.0, py::arg("distance") = 1.0,
      py::arg("bodies") = true, py::arg("ground") = false, py::arg("up") = "Y",
      py::arg("device") = py::none(), renderHelp.c_str());
}

}  // namespace ringlet::python

// Animations: written frame by frame, and read.
#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <atomic>
#include <cmath>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "python/arrays.h"
#include "python/grooms.h"
#include "python/hair.h"
#include "python/poses.h"
#include "ringlet/output/animation_reader.h"
#include "ringlet/output/animation_writer.h"

namespace ringlet::python {
namespace {

// A writer takes as many frames as it was told, all finite, until it is finished; this sees to it.
class WriterObject {
 public:
  ~WriterObject() {
    if (writer_) warnDropped();
  }
  WriterObject(std::filesystem::path path, GroomHandle groom, const AnimationOptions& options)
      : path_(std::move(path)), groom_(std::move(groom)), options_(options) {
    auto made = withoutGil([&] { return createAnimation(path_, groom_->groom(), options_); });
    if (!made && !animationFormatOf(path_)) throw py::value_error(made.error().message);
    writer_ = valueOf(std::move(made));
  }

  void add(std::span<const Vec3f> points, const UsdTransform& head = {}) {
    withoutGil([&] {
      const std::scoped_lock lock(mutex_);
      demandOpen();
      if (writer_->frameCount() >= options_.frameCount)
        throw Failure({fmt::format("{} was made for {} frames, and has them: say more as frames=",
                                   path_.string(), options_.frameCount),
                       Fault::output});
      demand(writer_->addFrame(points, head));
      frameCount_ = writer_->frameCount();
    });
  }
  void sync() {
    withoutGil([&] {
      const std::scoped_lock lock(mutex_);
      demandOpen();
      demand(writer_->sync());
    });
  }
  void finish() {
    withoutGil([&] {
      const std::scoped_lock lock(mutex_);
      demandOpen();
      if (writer_->frameCount() == 0)
        throw Failure(
            {fmt::format("{} has no frame: write() one before finish()", path_.string()), Fault::output});
      demand(writer_->finish());
      errorBound_ = writer_->errorBound();
      writer_.reset();
    });
  }
  // What there is stays as PATH.partial; nothing where it is closed.
  void close() {
    const std::scoped_lock lock(mutex_);
    writer_.reset();
  }

  const GroomHandle& groom() const { return groom_; }
  const std::filesystem::path& path() const { return path_; }
  int frameCount() const { return frameCount_; }
  bool isOpen() const {
    const std::scoped_lock lock(mutex_);
    return writer_ != nullptr;
  }
  double metresPerUnit() const { return options_.metresPerUnit; }
  std::optional<double> errorBound() const {
    const std::scoped_lock lock(mutex_);
    return writer_ ? writer_->errorBound() : errorBound_;
  }

 private:
  // As Python's files do.
  void warnDropped() const {
    const py::error_scope kept;  // an exception that is under way
    const std::string message =
        fmt::format("{} was dropped without finish() or close(); what was written is {}.partial",
                    path_.string(), path_.string());
    if (PyErr_WarnEx(PyExc_ResourceWarning, message.c_str(), 1) != 0) PyErr_WriteUnraisable(Py_None);
  }
  void demandOpen() const {
    if (!writer_) throw Failure({fmt::format("{} is closed", path_.string()), Fault::output});
  }

  std::filesystem::path path_;
  GroomHandle groom_;
  AnimationOptions options_;
  mutable std::mutex mutex_;
  std::unique_ptr<AnimationWriter> writer_;
  std::atomic<int> frameCount_ = 0;
  std::optional<double> errorBound_;
};
using WriterHandle = std::shared_ptr<WriterObject>;

double demandAbove(const char* name, double value) {
  if (!(value > 0) || !std::isfinite(value))
    throw py::value_error(fmt::format("{} must be above 0, got {}", name, value));
  return value;
}

// What only USD and Alembic files have.
struct UsdChoice {
  std::optional<double> tipWidth{};  // [m]
  std::vector<std::string> values{};
  std::string head = "baked";
  int clipFrames = 0;
};

UsdExtras usdExtrasOf(const UsdChoice& choice, const std::filesystem::path& path, double metresPerUnit) {
  const AnimationFormat* format = animationFormatOf(path);
  const bool isText = path.extension() == ".usda";
  if (choice.clipFrames < 0 || (choice.clipFrames > 0 && !isText))
    throw py::value_error(fmt::format("clip_frames must be 0 or, of a .usda, more; got {} for {}",
                                      choice.clipFrames, path.filename().string()));
  const bool isAsked = choice.tipWidth || !choice.values.empty() || choice.head != "baked";
  if (isAsked && !(format && format->hasValues))
    throw py::value_error(fmt::format("tip_width, values and head are of {}; got {}",
                                      animationEndings(&AnimationFormat::hasValues, "and"),
                                      path.filename().string()));

  UsdExtras extras{.clipFrames = choice.clipFrames};
  if (choice.tipWidth)
    extras.tipDiameter = static_cast<float>(demandAbove("tip_width", *choice.tipWidth) / metresPerUnit);
  for (const std::string& value : choice.values) {
    if (value == "id") {
      extras.ids = true;
    } else if (value == "rest") {
      extras.rest = true;
    } else if (value == "velocities") {
      if (isText && choice.clipFrames == 0)
        throw py::value_error("velocities are written into .usdc, .abc and clips only");
      extras.velocities = true;
    } else if (value == "unreal") {
      extras.unreal = true;
    } else {
      throw py::value_error(unknownName("value", value, {"id", "rest", "velocities", "unreal"}));
    }
  }
  if (choice.head == "transform") {
    extras.head = UsdHead::transform;
  } else if (choice.head == "none") {
    extras.head = UsdHead::none;
  } else if (choice.head != "baked") {
    throw py::value_error(unknownName("head", choice.head, {"baked", "transform", "none"}));
  }
  return extras;
}

struct WriterChoice {
  double fps = 24;
  int frames = 1000;
  std::optional<double> metresPerUnit{};
  std::string up = "Y";
  double width = 0.0005;  // [m]
  std::string precision = "float32";
  UsdChoice usd{};
};

WriterHandle makeWriter(const std::filesystem::path& path, const GroomHandle& groom,
                        const WriterChoice& choice) {
  constexpr int kMostFrames = 1'000'000;
  if (choice.frames < 1 || choice.frames > kMostFrames)
    throw py::value_error(fmt::format("frames must be from 1 to {}, got {}", kMostFrames, choice.frames));
  if (choice.up != "Y" && choice.up != "Z")
    throw py::value_error(unknownName("up axis", choice.up, {"Y", "Z"}));
  if (choice.precision != "float32" && choice.precision != "16bit")
    throw py::value_error(unknownName("precision", choice.precision, {"float32", "16bit"}));
  AnimationOptions options;
  options.framesPerSecond = demandAbove("fps", choice.fps);
  options.metresPerUnit =
      demandAbove("metres_per_unit", choice.metresPerUnit.value_or(groom->groom().metresPerUnit));
  options.up = choice.up == "Z" ? UpAxis::z : UpAxis::y;
  options.diameter = static_cast<float>(demandAbove("width", choice.width) / options.metresPerUnit);
  options.frameCount = choice.frames;
  options.precision = choice.precision == "16bit" ? CachePrecision::bits16 : CachePrecision::float32;
  options.usd = usdExtrasOf(choice.usd, path, options.metresPerUnit);
  return std::make_shared<WriterObject>(path, groom, options);
}

void writePoints(WriterObject& self, const py::object& points) {
  const PointsIn in(points, "points", self.groom()->particleCount());
  demandFinite(in.points(), "points");
  self.add(in.points());
}

void writePositions(WriterObject& self, const py::object& positions, const py::object& head) {
  const PointsIn in(positions, "positions", self.groom()->particleCount());
  demandFinite(in.points(), "positions");
  std::vector<Vec3f> points(in.points().begin(), in.points().end());
  const HeadPose pose = head.is_none() ? HeadPose{} : poseOf(head, "head");
  placeInWorld(points, pose, self.metresPerUnit());
  demandFinite(points, "positions in the file's unit");
  self.add(points, rigidTransform(pose.rotation, pose.position / self.metresPerUnit()));
}

using WriterClass = py::class_<WriterObject, WriterHandle>;

void addWriterFrames(WriterClass& writer) {
  writer
      .def(
          "write", &writePositions, py::arg("positions"), py::arg("head") = py::none(),
          "Adds a frame: (particles, 3) float32 [m] seen from the head, as positions() gives them, and where "
          "the head is, a Pose; None: at the world's origin.")
      .def("write_points", &writePoints, py::arg("points"),
           "Adds a frame: (particles, 3) float32 in the world, in the file's unit, as points() gives them.")
      .def_static(
          "formats",
          [] {
            std::vector<std::string> endings;
            for (const AnimationFormat& format : animationFormats()) endings.emplace_back(format.extension);
            return endings;
          },
          "The endings of names that files may have: a list.")
      .def("sync", &WriterObject::sync, "Returns when all frames so far are on the disk.")
      .def("finish", &WriterObject::finish, "Closes the file, of one frame at least, and gives it its name.")
      .def("close", &WriterObject::close,
           "Closes the file without its name: the frames so far stay as PATH.partial. Nothing where it is "
           "closed or finished. A writer that is dropped open does so with a ResourceWarning.");
}

void addWriterState(WriterClass& writer) {
  writer
      .def(
          "__repr__",
          [](const WriterObject& self) {
            return fmt::format("<ringlet.AnimationWriter {}: {} frames, {}>", self.path().string(),
                               self.frameCount(), self.isOpen() ? "open" : "closed");
          },
          "What it is, in a line.")
      .def_property_readonly("frame_count", &WriterObject::frameCount, "How many frames were added.")
      .def_property_readonly(
          "error_bound", &WriterObject::errorBound,
          "The farthest a point of the file may be from its own [m]; None: every bit is kept.")
      .def(
          "__enter__", [](const WriterHandle& self) { return self; }, "Itself.")
      .def(
          "__exit__",
          [](WriterObject& self, const py::object& type, const py::object&, const py::object&) {
            if (!self.isOpen()) return;
            if (type.is_none() && self.frameCount() > 0) return self.finish();
            self.close();
            if (type.is_none())
              throw Failure({fmt::format("no frame was written to {}", self.path().string()), Fault::output});
          },
          py::arg("type"), py::arg("value"), py::arg("traceback"),
          "Finishes the file; after an exception leaves it as PATH.partial.");
}

void addWriter(py::module_& module) {
  WriterClass writer(
      module, "AnimationWriter",
      "An animation on its way into a file, frame by frame; the ending of its name says the format "
      "(AnimationWriter.formats()). Until it is finished the file is PATH.partial, whole at every moment. As "
      "a context manager it finishes at the end; after an exception the .partial stays, with the frames so "
      "far:\n\n"
      "    with ringlet.AnimationWriter(\"hair.usda\", groom, frames=48) as animation:\n"
      "        scene.run(lambda frame: animation.write(frame.positions, frame.head), frames=48)");
  writer.def(
      py::init([](const std::filesystem::path& path, const GroomHandle& groom, double fps, int frames,
                  const std::optional<double>& metresPerUnit, const std::string& up, double width,
                  const std::string& precision, const std::optional<double>& tipWidth,
                  const std::vector<std::string>& values, const std::string& head, int clipFrames) {
        return makeWriter(path, groom,
                          {.fps = fps,
                           .frames = frames,
                           .metresPerUnit = metresPerUnit,
                           .up = up,
                           .width = width,
                           .precision = precision,
                           .usd = {tipWidth, values, head, clipFrames}});
      }),
      py::arg("path"), py::arg("groom").none(false), py::kw_only(), py::arg("fps") = 24.0,
      py::arg("frames") = 1000, py::arg("metres_per_unit") = py::none(), py::arg("up") = "Y",
      py::arg("width") = 0.0005, py::arg("precision") = "float32", py::arg("tip_width") = py::none(),
      py::arg("values") = std::vector<std::string>{}, py::arg("head") = "baked", py::arg("clip_frames") = 0,
      "fps: frames per second; frames: the most that will come, for which USD and .abc files keep room; "
      "metres_per_unit: of the file, None: the groom's; up: \"Y\" or \"Z\"; width: of strands [m]; "
      "precision: of .rgc, \"float32\" or \"16bit\". Of .usda, .usdc and .abc: tip_width: of strands at the "
      "tip [m], None: as width; values: of \"id\", \"rest\", \"unreal\" and \"velocities\" (.usdc, .abc and clips only); "
      "head: where the motion of write()'s head is, \"baked\" into the points, as a \"transform\" of the "
      "prim, or \"none\"; clip_frames: frames of a value clip of a .usda, 0: one file. ringlet.Error "
      "where the file cannot be written.");
  addWriterFrames(writer);
  addWriterState(writer);
}

// Frames one after the other, from the first.
class FramesObject {
 public:
  explicit FramesObject(const std::filesystem::path& path)
      : path_(path), reader_(withoutGil([&] { return valueOf(AnimationReader::open(path)); })) {}

  py::object next() {
    std::vector<Vec3f> points;
    const bool isThere = withoutGil([&] {
      const std::scoped_lock lock(mutex_);
      if (frame_ == reader_.frameCount()) return false;
      demand(reader_.readFrame(++frame_));
      points = reader_.groom().points;
      return true;
    });
    if (!isThere) throw py::stop_iteration();
    return arrayOf(std::move(points));
  }

  const AnimationReader& reader() const { return reader_; }
  int frameCount() const { return reader_.frameCount(); }
  double width() const { return double(reader_.header().diameter) * reader_.header().metresPerUnit; }
  std::vector<std::uint32_t> counts() const {
    std::vector<std::uint32_t> counts;
    const auto& first = reader_.groom().firstPoint;
    for (std::size_t s = 0; s + 1 < first.size(); ++s) counts.push_back(first[s + 1] - first[s]);
    return counts;
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  std::mutex mutex_;
  AnimationReader reader_;
  int frame_ = 0;
};

void addReader(py::module_& module) {
  py::class_<FramesObject>(
      module, "AnimationReader",
      fmt::format(
          "The frames of a {} file that Ringlet wrote, or of another program's animation (docs/formats.md), one "
          "after the other: `for points in ringlet.AnimationReader(path)` gives (particles, 3) float32 in the "
          "file's unit. Of a .partial those that are whole. Goes through once.",
          animationEndings(&AnimationFormat::isRead, "or"))
          .c_str())
      .def(py::init([](const std::filesystem::path& path) { return std::make_unique<FramesObject>(path); }),
           py::arg("path"), "ringlet.Error for a file that is missing or damaged, or in which nothing moves.")
      .def_property_readonly("frame_count", &FramesObject::frameCount, "How many frames there are.")
      .def_property_readonly(
          "fps", [](const FramesObject& self) { return self.reader().header().framesPerSecond; },
          "Frames per second.")
      .def_property_readonly(
          "metres_per_unit", [](const FramesObject& self) { return self.reader().header().metresPerUnit; },
          "The unit of points [m].")
      .def_property_readonly(
          "up", [](const FramesObject& self) { return self.reader().header().up == UpAxis::z ? "Z" : "Y"; },
          "\"Y\" or \"Z\".")
      .def_property_readonly("width", &FramesObject::width, "Of strands [m].")
      .def_property_readonly(
          "counts",
          [](const FramesObject& self) {
            const std::vector<std::uint32_t> counts = self.counts();
            return py::array_t<std::uint32_t>(static_cast<py::ssize_t>(counts.size()), counts.data());
          },
          "(strands,) uint32: the particles of each strand.")
      .def_property_readonly(
          "warnings", [](const FramesObject& self) { return self.reader().warnings(); },
          "What was lost of its end: a list of sentences.")
      .def(
          "__iter__", [](const py::object& self) { return self; }, "Itself.")
      .def("__next__", &FramesObject::next, "The next frame.")
      .def("__len__", &FramesObject::frameCount, "How many frames there are.")
      .def(
          "__repr__",
          [](const FramesObject& self) {
            return fmt::format("<ringlet.AnimationReader {}: {} frames>", self.path().string(),
                               self.frameCount());
          },
          "What it is, in a line.");
}

}  // namespace

void addAnimations(py::module_& module) {
  addWriter(module);
  addReader(module);
}

}  // namespace ringlet::python

// Implements convert_report.h.
#include "program/convert/convert_report.h"

#include <fmt/format.h>

#include "ringlet/output/precision_names.h"
#include "ringlet/run/report_rows.h"

namespace ringlet::program {
namespace {

using Json = ReportJson;
using Converted = ConvertReport;
using Source = AnimationReader;

std::string sizeText(std::uint64_t bytes) {
  return bytes < 1'000'000 ? fmt::format("{} bytes", bytes)
                           : fmt::format("{:.1f} MB", 1e-6 * static_cast<double>(bytes));
}

std::string boundText(double bound) {
  return bound == 0 ? "exact" : fmt::format("off by at most {:.3g} mm", 1000 * bound);
}

const char* upNameOf(const Source& source) { return source.header().up == UpAxis::z ? "Z" : "Y"; }

// [m]
double widthOf(const Source& source) { return source.header().diameter * source.header().metresPerUnit; }

// Of all points of all frames.
double bytesPerPoint(const Source& source) {
  const double points = static_cast<double>(source.groom().firstPoint.back()) * source.frameCount();
  return points > 0 ? static_cast<double>(source.byteCount()) / points : 0;
}

constexpr ReportRow<Converted> kConvertRows[] = {
    {{"frames", "", "Frames; 1 of a groom."}, [](const Converted& f) -> Json { return f.frameCount; }},
    {{"strands", "", "Strands."}, [](const Converted& f) -> Json { return f.groom.strandCount(); }},
    {{"particles", "", "Particles."}, [](const Converted& f) -> Json { return f.groom.points.size(); }},
    {{"bytes", "", "Size of the files."}, [](const Converted& f) -> Json { return f.byteCount; }},
    {{"error_bound_m", "m", "The farthest any point may be from what was simulated."},
     [](const Converted& f) { return f.errorBound ? Json(*f.errorBound) : Json(0); }},
    {{"warnings", "", "Sentences for a person."}, [](const Converted& f) -> Json { return f.warnings; }},
    {{"outputs", "", "The files written; of a sequence the first and the last."},
     [](const Converted& f) { return pathsOf(f.outputs); }},
};

constexpr ReportRow<Source> kAnimationRows[] = {
    {{"format", "", "Its name."}, [](const Source& f) -> Json { return f.formatKey(); }},
    {{"precision", "", "float32 or 16bit."},
     [](const Source& f) -> Json { return nameOf(f.header().precision); }},
    {{"finished", "", "Whether whatever wrote it ended."},
     [](const Source& f) -> Json { return f.isFinished(); }},
    {{"frames", "", "Frames."}, [](const Source& f) -> Json { return f.frameCount(); }},
    {{"strands", "", "Strands."}, [](const Source& f) -> Json { return f.groom().strandCount(); }},
    {{"particles", "", "Particles."}, [](const Source& f) -> Json { return f.groom().firstPoint.back(); }},
    {{"fps", "1/s", "Frames per second."},
     [](const Source& f) -> Json { return f.header().framesPerSecond; }},
    {{"metres_per_unit", "m", "Its unit."}, [](const Source& f) -> Json { return f.header().metresPerUnit; }},
    {{"up", "", "Its up axis, Y or Z."}, [](const Source& f) -> Json { return upNameOf(f); }},
    {{"width_m", "m", "Diameter of a strand."}, [](const Source& f) -> Json { return widthOf(f); }},
    {{"bytes", "", "Size of the file."}, [](const Source& f) -> Json { return f.byteCount(); }},
    {{"bytes_per_point", "", "That over all points of all frames."},
     [](const Source& f) -> Json { return bytesPerPoint(f); }},
    {{"error_bound_m", "m", "The farthest any point may be from what was simulated."},
     [](const Source& f) -> Json { return f.errorBound(); }},
    {{"warnings", "", "Sentences for a person."}, [](const Source& f) -> Json { return f.warnings(); }},
};

}  // namespace

nlohmann::ordered_json convertJson(const ConvertReport& report) { return objectOf<kConvertRows>(report); }
std::vector<ReportKey> convertKeys() { return keysOf<kConvertRows>(); }

std::string convertText(const ConvertReport& report) {
  const std::size_t strands = report.groom.strandCount();
  const std::string hair =
      fmt::format("{} strand{}, {} particles", strands, strands == 1 ? "" : "s", report.groom.points.size());
  const std::string output = report.outputs.front().string(), size = sizeText(report.byteCount);
  if (!report.errorBound)
    return fmt::format("a groom of {}, in units of {} m: {}, {}\n", hair, report.groom.metresPerUnit, output,
                       size);
  return fmt::format("{} frame{} of {}: {}{}, {}, {}\n", report.frameCount, report.frameCount == 1 ? "" : "s",
                     hair, output,
                     report.outputs.size() > 1 ? " to " + report.outputs.back().filename().string() : "",
                     size, boundText(*report.errorBound));
}

nlohmann::ordered_json animationJson(const AnimationReader& source) {
  return objectOf<kAnimationRows>(source);
}
std::vector<ReportKey> animationKeys() { return keysOf<kAnimationRows>(); }

std::string animationText(const std::filesystem::path& input, const AnimationReader& source) {
  const CacheHeader& header = source.header();
  std::string text =
      fmt::format("{}: {}, {}\n", input.string(),
                  source.isCache() ? "cache, " + nameOf(header.precision) : source.formatName(),
                  source.isFinished() ? "finished" : "not finished");
  text += fmt::format("  frames        {} at {} a second, {:.3g} s\n", source.frameCount(),
                      header.framesPerSecond, source.frameCount() / header.framesPerSecond);
  text += fmt::format("  strands       {}, {} particles, {:.3g} mm wide\n", source.groom().strandCount(),
                      source.groom().firstPoint.back(), 1000 * widthOf(source));
  text += fmt::format("  unit          {} m, {} up\n", header.metresPerUnit, upNameOf(source));
  text += fmt::format("  size          {}, {:.2f} bytes a point\n", sizeText(source.byteCount()),
                      bytesPerPoint(source));
  return text + fmt::format("  points        {}\n", boundText(source.errorBound()));
}

}  // namespace ringlet::program

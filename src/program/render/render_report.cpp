// Implements render_report.h.
#include "program/render/render_report.h"

#include "ringlet/run/report_rows.h"

namespace ringlet::program {
namespace {

using Json = ReportJson;
using Render = RenderReport;

bool isScale(const StrandColourChoice& colours) { return colours.scale->most > 0; }

constexpr ReportRow<StrandColourChoice> kColourRows[] = {
    {{"of", "", "The number of a strand, a name of --colour."},
     [](const StrandColourChoice& f) -> Json { return f.scale->name; }},
    {{"from", "", "What blue stands for; not of strand, as the two that follow."},
     [](const StrandColourChoice&) -> Json { return 0; },
     isScale},
    {{"to", "", "What red stands for."}, [](const StrandColourChoice& f) -> Json { return f.most; }, isScale},
    {{"unit", "", "The unit of both, 1 or m."},
     [](const StrandColourChoice& f) -> Json { return f.scale->unit; },
     isScale},
};

constexpr ReportRow<Render> kRenderRows[] = {
    {{"frames", "", "Finished pictures."}, [](const Render& f) -> Json { return f.outcome.frameCount; }},
    {{"strands", "", "Strands of the animation or groom."},
     [](const Render& f) -> Json { return f.outcome.strandCount; }},
    {{"hairs", "", "Hairs that are shown."}, [](const Render& f) -> Json { return f.outcome.hairCount; }},
    {{"points", "", "Points of these."}, [](const Render& f) -> Json { return f.outcome.pointCount; }},
    {{"width_m", "m", "Diameter of a hair."}, [](const Render& f) -> Json { return f.outcome.width; }},
    {{"size", "", "Width and height of a picture in pixels, as --size has them."},
     [](const Render& f) -> Json { return f.typed.size; }},
    {{"samples", "", "Samples along a pixel's side, as --samples has them."},
     [](const Render& f) -> Json { return f.typed.samples; }},
    {{"seconds_per_frame", "s",
      "Time of setting and drawing a picture, without files; mean over all but the first, which compiles "
      "kernels."},
     [](const Render& f) -> Json { return f.outcome.secondsPerFrame; }},
    {{"cpu_seconds_per_frame", "s", "The same of the processor, over all its cores."},
     [](const Render& f) -> Json { return f.outcome.cpuSecondsPerFrame; }},
    {{"start_seconds", "s",
      "Time before the first picture: reading for the camera, planning hair, compiling."},
     [](const Render& f) -> Json { return f.outcome.startSeconds; }},
    {{"stages_ms", "ms", "Time on the device a picture, by stage."},
     [](const Render& f) -> Json { return f.outcome.stages; }},
    {{"device", "", "Its name."}, [](const Render& f) -> Json { return f.device; }},
    {{"driver", "", "Its name and version."}, [](const Render& f) -> Json { return f.driver; }},
    {{"device_bytes", "", "Size of its buffers."},
     [](const Render& f) -> Json { return f.outcome.deviceBytes; }},
    {{"head", "", "Whether a head is shown that is no body of a scene."},
     [](const Render& f) -> Json { return f.outcome.showsHead; }},
    {{"interrupted", "", "Whether a signal ended it."},
     [](const Render& f) -> Json { return f.outcome.interrupted; }},
    {{"warnings", "", "Sentences for a person."}, [](const Render& f) -> Json { return f.outcome.warnings; }},
    {{"outputs", "", "The first and the last file written."},
     [](const Render& f) -> Json { return pathsOf(f.outcome.outputs); }},
    {{"colours", "", "With a --colour that shows a number of each strand.", keysOf<kColourRows>},
     [](const Render& f) { return objectOf<kColourRows>(*f.plan.colours); },
     [](const Render& f) { return f.plan.colours.has_value(); }},
    {{"ground_m", "m", "With --ground, its height."},
     [](const Render& f) { return orNull(f.outcome.groundHeight); },
     [](const Render& f) { return f.outcome.groundHeight.has_value(); }},
};

}  // namespace

nlohmann::ordered_json renderJson(const RenderReport& report) { return objectOf<kRenderRows>(report); }

std::vector<ReportKey> renderKeys() { return keysOf<kRenderRows>(); }

}  // namespace ringlet::program

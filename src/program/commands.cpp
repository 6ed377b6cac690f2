// Implements commands.h.
#include "program/commands.h"

#include <CLI/CLI.hpp>

#include "program/convert/convert_command.h"
#include "program/convert/make_command.h"
#include "program/convert/material_command.h"
#include "program/device/conform_command.h"
#include "program/device/devices_command.h"
#include "program/device/kernels_command.h"
#include "program/device/tune_command.h"
#include "program/measure/info_command.h"
#include "program/measure/measure_command.h"
#include "program/render/render_command.h"
#include "program/simulate/scene_command.h"
#include "program/simulate/simulate_command.h"
#include "program/sweep/sweep_command.h"
#include "program/view/view_command.h"
#include "ringlet/version.h"

namespace ringlet::program {

void addCommands(CLI::App& app, int& exitCode) {
  app.description("Ringlet simulates stylised curly hair on the GPU.");
  app.name("ringlet");
  app.set_version_flag("--version", "ringlet " RINGLET_VERSION);
  app.require_subcommand(1);
  app.get_formatter()->column_width(28);
  app.footer(
      "Example:\n  ringlet make head -o head.obj\n  ringlet simulate head.obj -o out\n\nEach command has its "
      "own --help.");
  addMakeCommand(app, exitCode);
  addSimulateCommand(app, exitCode);
  addSweepCommand(app, exitCode);
  addInfoCommand(app, exitCode);
  addMeasureCommand(app, exitCode);
  addRenderCommand(app, exitCode);
  addViewCommand(app, exitCode);
  addConvertCommand(app, exitCode);
  addSceneCommand(app, exitCode);
  addDevicesCommand(app, exitCode);
  addTuneCommand(app, exitCode);
  addConformCommand(app, exitCode);
  addKernelsCommand(app, exitCode);
  addMaterialCommand(app, exitCode);
}

}  // namespace ringlet::program

// Devices: those there are, and those that are open.
#include "python/devices.h"

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <optional>
#include <string>

namespace ringlet::python {

void addDevices(py::module_& module) {
  py::class_<DeviceSummary>(module, "DeviceSummary", "A Vulkan device that there is, as devices() lists it.")
      .def_readonly("index", &DeviceSummary::index, "By which Device() can be asked for it, as text.")
      .def_readonly("name", &DeviceSummary::name, "As the driver states it.")
      .def_readonly("type", &DeviceSummary::type, "discrete, integrated, virtual, cpu or other.")
      .def_readonly("driver", &DeviceSummary::driver, "Name and version.")
      .def_readonly("memory_bytes", &DeviceSummary::memoryBytes, "How much memory it has.")
      .def_readonly("subgroup_sizes", &DeviceSummary::subgroupSizes,
                    "That kernels can have, the default first: a list.")
      .def_readonly("usable", &DeviceSummary::usable, "Whether it has what the solver needs.")
      .def_readonly("why", &DeviceSummary::why, "If not: what is missing.")
      .def(
          "__repr__",
          [](const DeviceSummary& d) {
            return fmt::format("<ringlet.DeviceSummary {}: {}, {}{}>", d.index, d.name, d.driver,
                               d.usable ? "" : ", not usable: " + d.why);
          },
          "What it is, in a line.");
  module.def(
      "devices", [] { return withoutGil([] { return ComputeDevice::list(); }); },
      "The Vulkan devices there are: a list of DeviceSummary; empty where there is no Vulkan.");
  py::class_<DeviceObject, DeviceHandle>(
      module, "Device", "A Vulkan device that is open. It closes with the last that uses it.")
      .def(py::init([](const std::optional<std::string>& name, const std::filesystem::path& cacheFolder) {
             return std::make_shared<DeviceObject>(DeviceObject{
                 withoutGil([&] { return valueOf(ComputeDevice::open(name.value_or(""), cacheFolder)); })});
           }),
           py::arg("name") = py::none(), py::kw_only(), py::arg("cache_folder") = "",
           "Opens a device by part of its name or by index (\"0\"); None: $RINGLET_DEVICE, else the best. "
           "cache_folder: where compiled kernels are kept between programs, so that the next starts sooner; "
           "\"\": nowhere. ringlet.Error where there is no Vulkan or no such device.")
      .def_property_readonly(
          "name", [](const DeviceObject& d) { return d.device.name(); }, "As the driver states it.")
      .def_property_readonly(
          "driver", [](const DeviceObject& d) { return d.device.driver(); }, "Name and version.")
      .def(
          "validation_messages", [](const DeviceObject& d) { return d.device.validationMessages(); },
          "What the validation layer said, where RINGLET_VALIDATION=1 is set: a list, empty as it should be.")
      .def(
          "__repr__",
          [](const DeviceObject& d) { return fmt::format("<ringlet.Device: {}>", d.device.name()); },
          "What it is, in a line.");
}

}  // namespace ringlet::python

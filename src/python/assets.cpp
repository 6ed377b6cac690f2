// Assets: all of some hair that does not change.
#include "python/assets.h"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "python/settings.h"

namespace ringlet::python {
namespace {

KernelChoice kernelOf(const AssetChoice& choice) {
  KernelChoice kernel = kernelNamed(choice.kernel);
  if (choice.heads < 1) throw py::value_error(fmt::format("heads must be 1 or more, got {}", choice.heads));
  kernel.features = choice.features;
  kernel.heads = choice.heads;
  return kernel;
}

std::string assetRepr(const AssetObject& a) {
  std::string built;
  for (const FeatureName& feature : kFeatureNames)
    if (a.choice.features.*feature.member)
      built += (built.empty() ? ", with " : ", ") + std::string(feature.name);
  return fmt::format("<ringlet.Asset: {} strands, {} particles on {}{}>", a.asset.strandCount(),
                     a.asset.particleCount(), a.device->device.name(), built);
}

}  // namespace

KernelChoice kernelNamed(const std::string& name) {
  KernelChoice kernel;
  if (name == "lanes") {
    kernel.form = KernelChoice::Form::lanes;
  } else if (name == "memory") {
    kernel.form = KernelChoice::Form::memory;
  } else if (name == "serial") {
    kernel.form = KernelChoice::Form::serial;
  } else if (name != "auto") {
    throw py::value_error(unknownName("kernel", name, {"auto", "lanes", "memory", "serial"}));
  }
  return kernel;
}

Features featuresNamed(const std::vector<std::string>& names) {
  Features features;
  std::vector<std::string> known;
  for (const FeatureName& feature : kFeatureNames) known.emplace_back(feature.name);
  for (const std::string& name : names) {
    const auto found = std::ranges::find(kFeatureNames, name, &FeatureName::name);
    if (found == kFeatureNames.end()) throw py::value_error(unknownName("feature", name, known));
    features.*found->member = true;
  }
  return features;
}

AssetHandle buildAsset(DeviceHandle device, GroomHandle groom, const MaterialObject& material,
                       Settings settings, const AssetChoice& choice) {
  const KernelChoice kernel = kernelOf(choice);
  std::vector<std::string> warnings;
  const Material made = dialled(material, warnings);
  HairAsset built = withoutGil(
      [&] { return valueOf(HairAsset::build(device->device, groom->groom(), made, settings, kernel)); });
  warnings.insert(warnings.end(), built.warnings().begin(), built.warnings().end());
  return std::make_shared<AssetObject>(AssetObject{.device = std::move(device),
                                                   .groom = std::move(groom),
                                                   .material = made,
                                                   .settings = settings,
                                                   .asset = std::move(built),
                                                   .choice = choice,
                                                   .warnings = std::move(warnings)});
}

void addAssets(py::module_& module) {
  py::class_<AssetObject, AssetHandle>(
      module, "Asset",
      "All of some hair that does not change, for one device; any number of Hair share it. Constant.")
      .def(
          py::init([](const DeviceHandle& device, const GroomHandle& groom,
                      const std::optional<MaterialObject>& material, const std::optional<Settings>& settings,
                      const std::vector<std::string>& features, int heads, const std::string& kernel) {
            return buildAsset(device, groom, material.value_or(MaterialObject{}),
                              settings.value_or(Settings{}), {featuresNamed(features), heads, kernel});
          }),
          py::arg("device").none(false), py::arg("groom").none(false), py::arg("material") = py::none(),
          py::arg("settings") = py::none(), py::kw_only(), py::arg("features") = std::vector<std::string>{},
          py::arg("heads") = 1, py::arg("kernel") = "auto",
          "material, settings: None: the default. features: names of what hair begins with, of \"bodies\", "
          "\"roots\" (poses of strands' own), \"forces\", \"goals\" and \"fields\"; others are added when they are "
          "first used, which compiles kernels; heads: about how many will have this hair; kernel: \"auto\", "
          "\"lanes\", \"memory\" or \"serial\". ringlet.Error, with what to do, for settings that do not go "
          "together or a device without enough memory.")
      .def_property_readonly(
          "device", [](const AssetObject& a) { return a.device; }, "The Device.")
      .def_property_readonly(
          "groom", [](const AssetObject& a) { return a.groom; }, "The Groom.")
      .def_property_readonly(
          "material",
          [](const AssetObject& a) {
            return MaterialObject{a.material, {}};
          },
          "A copy of the Material, its dials worked in.")
      .def_property_readonly(
          "settings", [](const AssetObject& a) { return a.settings; }, "A copy of the Settings.")
      .def_property_readonly(
          "strand_count", [](const AssetObject& a) { return a.asset.strandCount(); }, "Strands of the groom.")
      .def_property_readonly(
          "particle_count", [](const AssetObject& a) { return a.asset.particleCount(); },
          "Particles of the groom.")
      .def_property_readonly(
          "rigid_strand_count", [](const AssetObject& a) { return a.asset.rigidStrandCount(); },
          "Strands that are carried rigidly, since they cannot be simulated.")
      .def_readonly("warnings", &AssetObject::warnings, "What one should know of it: a list of sentences.")
      .def("__repr__", &assetRepr, "What it is, in a line.");
}

}  // namespace ringlet::python

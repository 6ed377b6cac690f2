// Assets as Python holds them: what heads of the same hair share.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "python/devices.h"
#include "python/grooms.h"
#include "python/materials.h"
#include "ringlet/solver/hair_asset.h"

namespace ringlet::python {

/// "auto", "lanes", "memory" or "serial"; throws py::value_error.
KernelChoice kernelNamed(const std::string& name);

/// Of names, e.g. "bodies"; throws py::value_error.
Features featuresNamed(const std::vector<std::string>& names);

struct AssetChoice {
  Features features{};  // that hair begins with
  int heads = 1;
  std::string kernel = "auto";  // or lanes, memory, serial
};

struct AssetObject {
  DeviceHandle device;
  GroomHandle groom;
  Material material;  // its dials worked in
  Settings settings;
  HairAsset asset;
  AssetChoice choice{};
  std::vector<std::string> warnings{};
};
using AssetHandle = std::shared_ptr<AssetObject>;

AssetHandle buildAsset(DeviceHandle device, GroomHandle groom, const MaterialObject& material,
                       Settings settings, const AssetChoice& choice);

}  // namespace ringlet::python

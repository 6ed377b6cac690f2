// A number for each strand, from a primvar of a USD or Alembic groom's curves or from a picture at their UVs.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/groom/loaded_groom.h"

namespace ringlet {

/// One element of a primvar for each strand, `width` numbers each: its own, its root's, or the prim's. The
/// groom was read with keepsPrims. Errors: a prim without the primvar (the nearest name), texts.
Result<std::vector<double>> primvarOfStrands(const LoadedGroom& groom, const std::string& name,
                                             std::size_t& width);

/// The mean of a primvar's numbers, as of a colour.
Result<std::vector<double>> valuesOfPrimvar(const LoadedGroom& groom, const std::string& name);

/// The grey of a PNG file from 0 to 1, between its pixels, at the UVs that a primvar has; beyond 0 to 1 it
/// repeats. U goes right and V up. Errors: the file, or a primvar that is not of two numbers.
Result<std::vector<double>> valuesOfTexture(const LoadedGroom& groom, const std::filesystem::path& path,
                                            const std::string& uv);

}  // namespace ringlet

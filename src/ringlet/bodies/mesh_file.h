// Meshes from OBJ files: the surfaces of bodies. (Strands in OBJ files are groom/obj_file.h.)
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "ringlet/base/result.h"
#include "ringlet/bodies/triangle_mesh.h"

namespace ringlet {

/// Whether the name ends in .obj, in any case.
bool isObjMesh(const std::filesystem::path& path);

/// Reads the faces of an OBJ file, all its objects together, as one mesh in metres; metresPerUnit, in
/// [1e-6, 1000], says what its unit is. Polygons become triangles by a fan about their first point, which is
/// right for convex ones and keeps every one closed. Triangles of fewer than three places are left out.
/// Texture coordinates, normals, materials and lines are left aside. Errors, with the line: anything that
/// breaks `v` or `f`; a file without triangles, an unreadable one, more than memory holds.
Result<TriangleMesh> readObjMesh(const std::filesystem::path& path, double metresPerUnit);

/// The same with the triangles of fewer than three places: they may have three in another file of a sequence.
Result<TriangleMesh> readObjFaces(const std::filesystem::path& path, double metresPerUnit);

/// readObjMesh from the bytes of a file; `path` is for messages. Throws std::bad_alloc only.
Result<TriangleMesh> readObjMesh(std::span<const std::byte> bytes, const std::filesystem::path& path,
                                 double metresPerUnit);

}  // namespace ringlet

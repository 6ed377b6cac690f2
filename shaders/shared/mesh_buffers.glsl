// Meshes that bend, and what a dispatch over one of them is of.
#ifndef RINGLET_MESH_BUFFERS
#define RINGLET_MESH_BUFFERS

#include "layout/mesh_fields.h"

layout(set = 0, binding = kBindMeshes) readonly buffer Meshes { MeshRest meshes[]; };
layout(push_constant) uniform Parameters { MeshParameters parameters; };

#endif

// make_seeds FOLDER: small files for the fuzzers to begin with, FOLDER/FUZZER/NAME, as Ringlet itself writes
// them and as other programs would, and words to build files of, FOLDER/FUZZER.dict.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>

#include "ringlet/bodies/icosphere.h"
#include "ringlet/gpu/pipeline_cache_file.h"
#include "ringlet/groom/generate.h"
#include "ringlet/groom/hair_file.h"
#include "ringlet/groom/obj_file.h"
#include "ringlet/output/alembic/abc_writer.h"
#include "ringlet/output/cache_writer.h"
#include "ringlet/output/checkpoint_file.h"
#include "ringlet/output/usd/usd_writer.h"
#include "ringlet/output/usd/usdc_writer.h"
#include "ringlet/rest/material_file.h"
#include "ringlet/rest/material_parameters.h"
#include "ringlet/rest/material_presets.h"
#include "ringlet/scenes/builtin_scene.h"
#include "ringlet/scenes/file/scene_file.h"
#include "ringlet/scenes/load/scene_parts.h"
#include "ringlet/solver/plan/shape_cost_file.h"
#include "tests/groom/abc_curve_samples.h"
#include "tests/groom/crate_bytes.h"
#include "tests/groom/ply_samples.h"
#include "tests/groom/strand_list_bytes.h"
#include "tests/groom/tfx_bytes.h"
#include "tests/groom/usda_samples.h"
#include "tests/groom/zip_bytes.h"
#include "tests/motion/abc_samples.h"
#include "tests/motion/gltf_samples.h"
#include "tests/motion/mesh_motion_samples.h"
#include "tests/motion/usd_clip_samples.h"
#include "tests/motion/usd_skin_samples.h"

namespace ringlet::fuzz {
namespace {

namespace fs = std::filesystem;

// Where a seed goes; its folder is made.
fs::path seed(const fs::path& folder, const std::string& fuzzer, const std::string& name) {
  fs::create_directories(folder / fuzzer);
  return folder / fuzzer / name;
}
void write(const fs::path& path, const std::string& text) { std::ofstream(path, std::ios::binary) << text; }

// Two curls of six points.
Groom smallGroom() {
  const auto groom = makeSwatch({.curl = {.particleCount = 6}, .columnCount = 2, .rowCount = 1});
  return groom ? *groom : Groom{};
}

Status writeGrooms(const fs::path& folder) {
  const Groom groom = smallGroom();
  write(seed(folder, "tfx_file", "three"), test::TfxBytes{}.bytes());
  write(seed(folder, "tfx_file", "two"), test::TfxBytes::uniform(2, 8).bytes());
  write(seed(folder, "obj_file", "edges"), "v 0 0 0\nv 0 -1 0\nv 0 -2 0.5\nl 2 3\nl -3 -2\n");
  if (Status status = writeHair(seed(folder, "hair_file", "curls"), groom); !status) return status;
  return writeObj(seed(folder, "obj_file", "curls"), groom);
}

// As other programs write them; the animations are seeds of usda_file, too.
void writeOthersGrooms(const fs::path& folder) {
  const std::string linear = test::curves(test::kTwoStrands, "( upAxis = \"Z\" metersPerUnit = 0.01 )");
  const std::string cubic =
      "int[] curveVertexCounts = [4, 5] point3f[] points = "
      "[(0,0,0),(0,1,0),(1,2,0),(0,3,0),(0,0,1),(0,1,1),(2,2,1),"
      "(0,3,1),(0,4,1)] ";
  write(seed(folder, "usda_file", "linear"), linear);
  for (const char* basis : {"bspline", "catmullRom"}) {
    write(seed(folder, "usda_file", basis),
          test::curves(
              fmt::format("{}uniform token basis = \"{}\" uniform token wrap = \"pinned\"", cubic, basis)));
  }
  write(seed(folder, "usda_file", "placed"),
        "#usda 1.0\ndef Xform \"A\" ( active = true ) {\ndouble3 xformOp:translate = (1, 2, 3)\nfloat3 "
        "xformOp:rotateXYZ = (1, 2, 3)\nmatrix4d xformOp:transform = "
        "((1,0,0,0),(0,1,0,0),(0,0,1,0),(0,0,0,1))\n"
        "quatf xformOp:orient = (1, 0, 0, 0)\nuniform token[] xformOpOrder = [\"xformOp:translate\", "
        "\"xformOp:rotateXYZ\", \"!invert!xformOp:translate\", \"xformOp:orient\", \"xformOp:transform\"]\n"
        "token visibility = \"inherited\"\n" +
            linear.substr(linear.find("def")) +
            "}\nclass \"B\" ( prepend references = @a.usd@</A> ) { variantSet \"v\" = { \"a\" { } } }\n");
  test::CrateBytes moving;
  for (const char* name : {"points", "curveVertexCounts", "type", "basis", "Hair"}) moving.name(name);
  moving.addRoot({"Hair"}, {{"upAxis", moving.token("Y")}});
  moving.addPrim("/Hair", "BasisCurves");
  const auto points = moving.points({{0, 0, 0}, {0, 1, 0}, {1, 2, 0}, {0, 3, 0}});
  moving.add("/Hair.points", test::CrateBytes::kAttribute,
             {{"timeSamples", moving.samples({1, 2}, {points, points})}});
  moving.addAttribute("/Hair.curveVertexCounts", moving.integers({4}));
  moving.addAttribute("/Hair.basis", moving.token("bspline"));
  write(seed(folder, "usdc_file", "small"), test::CrateBytes::small().bytes());
  write(seed(folder, "usdc_file", "moving"), moving.bytes());
  write(seed(folder, "usdz_file", "text"), test::ZipBytes{.content = linear}.bytes());
  write(seed(folder, "usdz_file", "crate"),
        test::ZipBytes{.name = "a.usdc", .content = moving.bytes(), .others = 1}.bytes());
  write(seed(folder, "usda_file", "left_out"),
        linear +
            "def BasisCurves \"Rig\" { rel skel:skeleton = </S> uniform token wrap = \"periodic\" point3f[] "
            "points.timeSamples = { 1: [], 2: [(0,0,0),(0,1,nan)] } uniform token[] xformOpOrder = "
            "[\"xformOp:scale\"] }\n");
  write(seed(folder, "obj_file", "left_out"),
        "v 0 0 0\nv 0 1 0\nv 0 2 nan\nl 1 2\nl 2 1\nl 1 2 1\nl 3 3\nl 1 2 3\nl 1\nl 2 3 1 2\n");
  write(seed(folder, "ply_file", "text"), test::plyText());
  write(seed(folder, "ply_file", "bytes"), test::plyBinary());
  write(seed(folder, "ply_file", "edges"),
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
        "z\nelement edge "
        "2\nproperty int vertex1\nproperty int vertex2\nend_header\n0 0 0\n0 1 0\n0 2 0\n0 1\n1 2\n");
  write(seed(folder, "strand_list_file", "data"), test::strandList({3, 1, 2}, 3));
  write(seed(folder, "strand_list_file", "bin"), test::strandList({3, 1, 2}, 7));
}

// Of every form, below objects that move, with values of every scope, indexed ones among them.
void writeAbcGrooms(const fs::path& folder) {
  using test::AbcBytes;
  const std::vector<std::int32_t> counts{4, 7};
  const std::vector<Vec3d> points = test::abcCurl(counts);
  const auto scoped = [](const std::string& name, std::size_t count, const char* scope) {
    return test::abcArray(name, AbcBytes::f32, test::abcNumbers(std::vector<float>(count, 0.5f)), 1,
                          fmt::format("geoScope={};isGeomParam=true", scope));
  };
  const AbcBytes::Property sides = test::abcArray(".vals", AbcBytes::text, std::string("left\0right\0", 11));
  const AbcBytes::Property indices =
      test::abcArray(".indices", AbcBytes::i32, test::abcNumbers<std::int32_t>({1, 0}));
  test::AbcCurveForm linear{.more = {scoped("width", 11, "vtx"), scoped("uv", 2, "uni")}};
  linear.params = {scoped("groom_guide", 1, "con"),
                   {.name = "side", .metadata = "geoScope=uni", .parts = {sides, indices}}};
  write(seed(folder, "abc_groom", "linear"),
        test::abcFile({test::abcCurves("hair", counts, points, linear)}));
  std::string knots;
  for (const int count : counts)
    for (int k = 0; k < count + 4; ++k) knots += test::abcNumber(static_cast<float>(std::clamp(k, 3, count)));
  for (std::uint8_t basis = 1; basis < 4; ++basis) {
    const test::AbcCurveForm cubic{.type = basis == 3 ? test::kAbcVariable : test::kAbcCubic,
                                   .basis = basis,
                                   .more = {test::abcArray(".knots", AbcBytes::f32, knots)}};
    write(seed(folder, "abc_groom", fmt::format("cubic{}", basis)),
          test::abcFile({test::abcXform("up", {0x10, 0x40}, {{0, 1, 2, 30}, {0, 1, 2, 40}}, 1,
                                        {test::abcCurves("hair", counts, points, cubic)})}));
  }
  write(seed(folder, "abc_groom", "moving"),
        test::abcFile({test::abcMovingCurves(
            "hair", {{}, {4}, {2}}, {{}, test::abcCurl({4}), test::abcCurl({2})}, {.sampling = 1})}));
}

void writeMeshes(const fs::path& folder) {
  const TriangleMesh mesh = makeIcosphere(1);
  std::string text;
  for (const Vec3d& p : mesh.points) text += fmt::format("v {} {} {}\n", p.x, p.y, p.z);
  for (const auto& t : mesh.triangles) text += fmt::format("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
  write(seed(folder, "mesh_file", "ball"), text);
  write(seed(folder, "mesh_file", "pyramid"),
        "v 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\nv 0.5 1 0.5\nf 1 2 3 4\nf 1//1 5/2 -4/1/1\nf 2 5 3\nf 3 5 4\nf "
        "4 5 1\n");
}

// Below objects that move, with times of each kind and a sample that is stored once.
test::AbcBytes placedAbcMesh(const std::vector<std::vector<Vec3d>>& samples) {
  test::AbcBytes file;
  file.samplings = {{}, {0.04, {1}}, {1, {0, 0.25}}, {test::AbcBytes::kNoCycle, {0, 1, 3, 4, 9}}};
  test::AbcBytes::Object mesh =
      test::abcMesh("M", {4, 3}, {0, 2, 1, 0, 0, 1, 2}, samples, 3, "AbcGeom_SubD_v1");
  test::AbcBytes::Property& points = mesh.properties[0].parts[0];
  points.count = 5;
  points.firstChanged = points.lastChanged = 2;
  const std::vector<double> matrix{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  file.objects = {
      test::abcXform("A", {0x10, 0x00, 0x20}, {{1, 2, 3, 1, 1, 2, 0, 0, 1, 30}}, 0,
                     {test::abcXform("B", {0x50}, {{0}, {90}, {0}}, 2,
                                     {test::abcXform("C", {0x30}, {matrix, matrix}, 1, {mesh})})})};
  return file;
}

void writeMotions(const fs::path& folder) {
  write(seed(folder, "bvh_file", "neck"),
        "HIERARCHY\nROOT Hips\n{\n\tOFFSET 0 0 0\n\tCHANNELS 6 Xposition Yposition Zposition Zrotation "
        "Xrotation "
        "Yrotation\n\tJOINT Head\n\t{\n\t\tOFFSET 0 10 0\n\t\tCHANNELS 3 Zrotation Xrotation Yrotation\n"
        "\t\tEnd Site\n\t\t{\n\t\t\tOFFSET 0 2 0\n\t\t}\n\t}\n}\nMOTION\nFrames: 2\nFrame Time: 0.04\n"
        "1 2 3 0 0 0 0 0 0\n1 2 4 5 6 7 8 9 -1.5e1\n");
  const std::vector<std::vector<Vec3d>> samples{{{}, {1, 0, 0}, {0, 1, 0}},
                                                {{0, 0, 1}, {1, 0, 1}, {0, 1, 2}}};
  write(seed(folder, "point_cache", "triangle.pc2"), test::pc2Bytes(samples));
  write(seed(folder, "point_cache", "triangle.mdd"), test::mddBytes(samples, 0.04));
  write(seed(folder, "usd_mesh", "triangle.usdc"), test::usdcBytes({{0, 1, 2}}, samples, 24));
  write(seed(folder, "usd_mesh", "triangle.usda"),
        test::usdaText({{0, 1, 2}}, samples, 24,
                       "  double3 xformOp:translate.timeSamples = { 1: (0, 0, 0), 4: (0, 3, 0) }\n"
                       "  uniform token[] xformOpOrder = [\"xformOp:translate\"]\n"));
  // Value clips, which are the file itself: another prim of it.
  const std::string other = test::clipText({1, 2}, samples, "", "over \"C\"").substr(10);
  const test::SampleClipSet stated{.files = {"self", "self"},
                                   .active = {{1, 0}, {3, 1}, {5, 0}},
                                   .times = {{1, 1}, {2, 2}, {2, 1}, {3, 1.5}, {6, 2}},
                                   .primPath = "/C"},
      made{.form = test::SampleTemplate{"self.#", 1, 3, 1, 0.5}, .primPath = "/C"};
  write(seed(folder, "usd_mesh", "clips.usda"),
        test::clippedText({{0, 1, 2}}, 24, test::clipsText({stated}, "prepend clipSets = [\"default\"]\n")) +
            other);
  write(seed(folder, "usd_mesh", "template.usda"),
        test::clippedText({{0, 1, 2}}, 24, test::clipsText({made})) + other);
  write(seed(folder, "usd_mesh", "clips.usdc"), test::clippedCrate({{0, 1, 2}}, 24, {stated, made}));
  write(seed(folder, "usd_mesh", "arm.usda"), test::arm::scene().text());
  write(seed(folder, "usd_mesh", "arm.usdc"), test::arm::scene().crate());
  write(seed(folder, "abc_mesh", "triangle"), test::abcMeshBytes({{0, 1, 2}}, samples, 24));
  write(seed(folder, "abc_mesh", "placed"), placedAbcMesh(samples).bytes());
  const test::GltfBuilder strip = test::bendingStrip(1, 5121, 5126);
  write(seed(folder, "gltf_file", "strip.gltf"), strip.text());
  write(seed(folder, "gltf_file", "strip.glb"), strip.glb());
}

// Built-in scenes name a groom's file; those that run have a generator.
void writeScenes(const fs::path& folder) {
  for (const std::string& name : sceneNames()) {
    auto scene = makeScene(name, {.particles = 8});
    if (scene) write(seed(folder, "scene_file", name), sceneText(sceneFileOf(*scene, "groom.obj")));
  }
  const std::string groom = "[groom]\ngenerate = \"swatch\"\ncolumns = 2\nrows = 2\nparticles = 8\n";
  const std::string simulation = "[simulation]\nsteps_per_frame = 2\nframes = 2\n";
  const std::pair<const char*, const char*> parts[] = {
      {"still", ""},
      {"shake", "[motion]\nkind = \"shake\"\namplitude = 0.2\n"},
      {"keys",
       "[[motion.key]]\ntime = 0\n[[motion.key]]\ntime = 0.1\nposition = [0, 0.1, 0]\n"
       "rotate_degrees = [0, 30, 0]\n"},
      {"contacts", "[contacts]\non = true\n"},
      {"sphere", "[[body]]\nshape = \"sphere\"\nradius = 0.05\n"},
      {"head", "[[body]]\nshape = \"mesh\"\ngenerate = \"head\"\ncells = 8\nscale = 0.5\n"},
      {"boxes",
       "[[body]]\nshape = \"box\"\n[[body]]\nshape = \"plane\"\nposition = [0, -0.2, 0]\nmoves = "
       "\"still\"\n"},
      {"material",
       "[material]\npreset = \"coil\"\n[material.dials]\nhold = 2\n[material.profile]\n"
       "bend_stiffness = [[0, 1], [1, 0.5]]\n"}};
  for (const auto& [name, text] : parts) {
    write(seed(folder, "scene_run", name), groom + simulation + text);
    write(seed(folder, "scene_file", std::string("run_") + name), groom + simulation + text);
  }
  for (const char* integrator : {"paper", "point_jacobi"})
    write(seed(folder, "scene_run", integrator),
          fmt::format("{}{}integrator = \"{}\"\n", groom, simulation, integrator));
}

Status writeTables(const fs::path& folder) {
  for (const std::string& name : presetNames())
    write(seed(folder, "material_file", name), materialText(*materialPreset(name), {.hold = 1.5}));
  const std::string digits =
      "bend_stiffness = 8.123456789012345\n[profile]\nbend_stiffness = [[0, 0.1234567890123], [1, 1]]\n";
  write(seed(folder, "material_file", "digits"), digits);
  write(seed(folder, "velocities", "small"),
        std::string("\x93NUMPY\x01\x00\x76\x00", 10) +
            "{'descr': '<f4', 'fortran_order': False, 'shape': (2, 2, 2, 3), }" + std::string(53, ' ') +
            "\n" + std::string(96, '\0'));
  write(seed(folder, "strand_factors", "named"), std::string("strand,factor\n0,2\n7,0.5 # soft\n\n3,1e-2\n"));
  const DeviceCosts device{
      "a GPU", "driver 1", "9c0f3a51e2d47b68", {{{4, 16}, 612.5}, {kAnySerialShape, 46}}, 8};
  if (Status status = writeShapeCosts(seed(folder, "shape_cost_file", "two"), {device, device}); !status)
    return status;
  // Vulkan's own header: its size, version 1, vendor, device, an id of 16 bytes; and what the driver likes.
  std::string driver(48, '\0');
  const std::uint32_t words[] = {32, 1, 0x10005, 0};
  std::memcpy(driver.data(), words, sizeof words);
  gpu::writePipelineCache(seed(folder, "pipeline_cache_file", "two"),
                          {.vendor = 0x10005, .device = 0, .driverVersion = 1},
                          std::as_bytes(std::span(driver)));
  return {};
}

template <class Writer>
Status writeFrames(Result<Writer> writer, const Groom& groom, bool isFinished) {
  if (!writer) return writer.error();
  for (int frame = 0; frame < 2; ++frame) {
    if (Status added = writer->addFrame(groom.points); !added) return added;
  }
  return isFinished ? writer->finish() : Status{};
}

// Finished, and left by a killed run.
Status writeAnimations(const fs::path& folder) {
  const Groom groom = smallGroom();
  for (const bool isFinished : {true, false}) {
    const std::string name = isFinished ? "finished" : "killed";
    for (const auto precision : {CachePrecision::float32, CachePrecision::bits16}) {
      const fs::path path =
          seed(folder, "cache_reader", name + std::to_string(static_cast<std::uint32_t>(precision)));
      if (Status done =
              writeFrames(CacheWriter::create(path, groom, {.precision = precision}), groom, isFinished);
          !done)
        return done;
    }
    const fs::path path = seed(folder, "usd_reader", name);
    if (Status done = writeFrames(UsdWriter::create(path, groom, {.frameCount = 2}), groom, isFinished);
        !done)
      return done;
    if (isFinished) {
      fs::copy_file(path, seed(folder, "usda_file", "own"));
      fs::copy_file(path, seed(folder, "foreign_frames", "text"));
    }

    AnimationOptions all{.frameCount = 2};
    all.usd = {.ids = true, .rest = true, .velocities = true, .head = UsdHead::transform};
    const fs::path crate = seed(folder, "usdc_reader", name);
    if (Status done = writeFrames(UsdcWriter::create(crate, groom, all), groom, isFinished); !done)
      return done;
    if (isFinished) {
      fs::copy_file(crate, seed(folder, "usdc_file", "own"));
      fs::copy_file(crate, seed(folder, "foreign_frames", "crate"));
    }
    const fs::path archive = seed(folder, "abc_reader", name);
    if (Status done = writeFrames(AbcWriter::create(archive, groom, all), groom, isFinished); !done)
      return done;
    if (isFinished) {
      fs::copy_file(archive, seed(folder, "abc_groom", "own"));
      fs::copy_file(archive, seed(folder, "foreign_frames", "archive"));
    }
  }
  return {};
}

Status writeCheckpoints(const fs::path& folder) {
  const Checkpoint empty{.everyFrames = 10};
  const Checkpoint full{.facts = {{"frames", "24"}, {"kernel", "lanes 4 x 16"}},
                        .everyFrames = 5,
                        .frame = 20,
                        .computed = std::vector<std::byte>(40),
                        .written = std::vector<std::byte>(9)};
  for (const auto& [name, checkpoint] : {std::pair{"empty", empty}, {"full", full}}) {
    if (Status done = writeCheckpoint(seed(folder, "checkpoint_file", name), checkpoint); !done) return done;
  }
  return {};
}

// A quoted word a line.
template <class Words>
std::string dictionary(const Words& words) {
  std::string text;
  for (const std::string& word : words) text += fmt::format("\"{}\"\n", word);
  return text;
}

void writeDictionaries(const fs::path& folder) {
  write(folder / "usd_reader.dict",
        dictionary(std::vector<std::string>{"000000000", "(0, 0, 0),", "]", "1e38"}));
  const std::vector<std::string> usd{"#usda 1.0",
                                     "def BasisCurves",
                                     "point3f[] points = [",
                                     "int[] curveVertexCounts = [",
                                     "uniform token",
                                     "type = ",
                                     "\\\"cubic\\\"",
                                     "\\\"linear\\\"",
                                     "basis = ",
                                     "wrap = ",
                                     "\\\"periodic\\\"",
                                     ".timeSamples = {",
                                     ".connect = ",
                                     "xformOpOrder = [",
                                     "xformOp:transform",
                                     "!resetXformStack!",
                                     "active = ",
                                     "references = @a@",
                                     "variantSet",
                                     "None",
                                     "PXR-USDC",
                                     "primChildren",
                                     "rel skel:skeleton = </A>",
                                     "skel:animationSource",
                                     "primvars:skel:jointIndices",
                                     "clips = { dictionary default = {",
                                     "assetPaths = [@self@]",
                                     "active = [(1, 0), (2, 1)]",
                                     "times = [(1, 1), (2, 2), (2, 1)]",
                                     "templateAssetPath",
                                     "primPath",
                                     "nan",
                                     "1e38"};
  for (const char* fuzzer : {"usda_file", "usdc_file", "usdz_file", "usd_mesh", "foreign_frames"})
    write(folder / (std::string(fuzzer) + ".dict"), dictionary(usd));
  write(folder / "abc_mesh.dict",
        dictionary(std::vector<std::string>{"AbcGeom_PolyMesh_v1", "AbcGeom_SubD_v1", "AbcGeom_Xform_v3",
                                            ".geom", ".xform", ".faceIndices", ".faceCounts", ".inherits"}));
  write(folder / "abc_groom.dict", dictionary(std::vector<std::string>{"AbcGeom_Curve_v2",
                                                                       "AbcGeom_Xform_v3",
                                                                       ".geom",
                                                                       ".xform",
                                                                       "P",
                                                                       "nVertices",
                                                                       "curveBasisAndType",
                                                                       ".orders",
                                                                       ".knots",
                                                                       "w",
                                                                       ".arbGeomParams",
                                                                       "width",
                                                                       "uv",
                                                                       ".vals",
                                                                       ".indices",
                                                                       "visible",
                                                                       ".instanceSource",
                                                                       "geoScope=uni",
                                                                       "geoScope=vtx",
                                                                       "interpretation=rgb"}));
  write(folder / "ply_file.dict", dictionary(std::vector<std::string>{
                                      "element strand ", "element edge ", "property list uchar int ", "nsegs",
                                      "vertex1", "format binary_little_endian 1.0", "end_header"}));
  std::vector<std::string> keys;
  for (const auto& parameter : materialParameters()) keys.push_back(parameter.key);
  for (const auto& parameter : dialParameters()) keys.push_back(parameter.key);
  for (const auto& parameter : variationParameters()) keys.push_back(parameter.key);
  for (const char* table : {"[dials]", "[variation]", "[profile]", "[[0, 1], [1, 2]]"}) keys.push_back(table);
  write(folder / "material_file.dict", dictionary(keys));
  for (const SceneKey& key : sceneKeys()) keys.push_back(key.key + " = ");
  for (const char* table : {"[groom]", "[motion]", "[simulation]", "[contacts]", "[air]", "[[body]]",
                            "[material]", "[[motion.key]]", "[output]", "[scalp]", "[0, 0, 0]"})
    keys.push_back(table);
  for (const char* fuzzer : {"scene_file", "scene_run"})
    write(folder / (std::string(fuzzer) + ".dict"), dictionary(keys));
}

Status writeAll(const fs::path& folder) {
  writeOthersGrooms(folder);
  writeAbcGrooms(folder);
  writeMeshes(folder);
  writeMotions(folder);
  writeScenes(folder);
  writeDictionaries(folder);
  for (const auto part : {writeGrooms, writeTables, writeAnimations, writeCheckpoints}) {
    if (Status status = part(folder); !status) return status;
  }
  return {};
}

}  // namespace
}  // namespace ringlet::fuzz

int main(int count, char** words) {
  if (count != 2) {
    std::fprintf(stderr, "usage: make_seeds FOLDER\n");
    return 2;
  }
  const ringlet::Status status = ringlet::fuzz::writeAll(words[1]);
  if (!status) std::fprintf(stderr, "%s\n", status.error().message.c_str());
  return status ? 0 : 1;
}

// Pictures: what is seen, how much of it, what is dark behind what; the same bits by every path a device may
// take.
#include "ringlet/render/hair_renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "layout/picture.h"
#include "ringlet/bodies/icosphere.h"
#include "ringlet/gpu/device_buffers.h"
#include "ringlet/gpu/recorder.h"
#include "ringlet/groom/generate.h"
#include "ringlet/render/strand_points.h"
#include "ringlet/render/stretch_colours.h"
#include "tests/support/gpu_test.h"

namespace ringlet::test::hair_renderer_test {
namespace {

struct Scene {
  std::vector<std::uint32_t> firstPoint{0};
  std::vector<Vec3f> points;  // [m]
  double width = 0.001;
  std::vector<SolidMesh> solids{};
  std::vector<SolidPlace> places{};
  Bounds bounds{{-0.3, -0.3, -0.3}, {0.3, 0.3, 0.3}};
  Camera camera{.eye = {0, 0, 1}};

  void addStrand(std::vector<Vec3f> strand) {
    points.insert(points.end(), strand.begin(), strand.end());
    firstPoint.push_back(static_cast<std::uint32_t>(points.size()));
  }
};

struct Drawn {
  std::vector<std::uint32_t> shown;
  std::vector<float> light;
};

Drawn draw(gpu::Device& device, const Scene& scene, const PictureSize& size, const Look& look = {},
           int moments = 1) {
  auto strands = StrandPoints::create(device, scene.firstPoint);
  EXPECT_TRUE(strands);
  EXPECT_TRUE(strands->setPose(scene.points, 1));
  auto renderer = HairRenderer::create(device, {strands->points(), strands->firstPoint(), scene.width},
                                       scene.solids, size, look);
  EXPECT_TRUE(renderer) << renderer.error().message;
  EXPECT_TRUE(renderer->setFrame(scene.camera, scene.bounds, scene.places));
  auto recorder = gpu::Recorder::create(device, "picture");
  for (int k = 0; k < moments; ++k) {
    EXPECT_TRUE(recorder->begin());
    renderer->record(*recorder, k == 0);
    EXPECT_TRUE(recorder->submitAndWait());
  }
  return {*renderer->picture(), *renderer->light()};
}

// A head of curls on a ball.
Scene headScene(int strands = 60) {
  Scene scene;
  const Groom groom = *makeHead({.strandCount = strands});
  scene.firstPoint = groom.firstPoint;
  for (const Vec3f& p : groom.points) scene.points.push_back(p * static_cast<float>(groom.metresPerUnit));
  scene.width = 0.002;
  TriangleMesh ball = makeIcosphere(8);
  for (Vec3d& p : ball.points) p = p * 0.085;
  scene.solids = {solidMeshOf(ball)};
  scene.places = {{{}, {}}};
  scene.camera = {.eye = {0.6, 0.1, 0.9}, .target = {0, -0.1, 0}};
  return scene;
}

// Nothing shines but what is behind all, in white: a pixel is what is not covered.
Look silhouette() {
  Look look;
  look.key = look.rim = look.skyAbove = look.skyBelow = {};
  look.backMiddle = look.backEdge = {1, 1, 1};
  look.tipRadius = 1;
  return look;
}

double covered(const std::vector<float>& light) {
  double sum = 0;
  for (std::size_t i = 0; i < light.size(); i += 3) sum += 1 - light[i];
  return sum;  // [pixels]
}

double meanLight(const std::vector<float>& light) {
  double sum = 0;
  for (const float value : light) sum += value;
  return sum / static_cast<double>(light.size());
}

constexpr int kWidth = 160, kHeight = 120;
// Pixels a metre at the target, of a camera a metre away.
double pixelsPerMetre(const Camera& camera) { return kHeight / 2.0 / std::tan(camera.fieldOfView / 2); }

using HairRendererTest = GpuTest;

// However thin or thick a hair is, and whichever way it goes, it covers its area.
TEST_F(HairRendererTest, HairsCoverTheirArea) {
  for (const int side : {1, 2, 3, 4}) {
    for (const double width : {0.0002, 0.0008, 0.003, 0.01}) {
      for (const double angle : {0.0, 0.4, 0.8, 1.5}) {
        Scene scene;
        scene.width = width;
        // Many hairs side by side, so far apart that none hits another's samples, so that chance evens out.
        const Vec3d along{std::cos(angle), std::sin(angle), 0}, beside{-along.y, along.x, 0};
        const double scale = pixelsPerMetre(scene.camera), apart = width + 2.5 / (scale * side);
        const int count = std::min(40, static_cast<int>(0.16 / apart));
        for (int h = 0; h < count; ++h) {
          std::vector<Vec3f> strand;
          for (int i = 0; i < 12; ++i)
            strand.push_back(Vec3f(along * (0.016 * (i - 5.5)) + beside * (apart * (h - 0.5 * count))));
          scene.addStrand(strand);
        }
        const double area = count * width * 0.176 * scale * scale;
        const double found = covered(draw(gpu(), scene, {kWidth, kHeight, side}, silhouette()).light);
        // Samples hit by chance: their number is right to its root. Ends are cut at samples.
        const double samples = area * side * side;
        EXPECT_NEAR(
            found, area,
            area * 0.015 + 3 * std::sqrt(samples) / (side * side) + 0.5 * count * width * scale / side)
            << side << " " << width << " " << angle;
      }
    }
  }
}

TEST_F(HairRendererTest, BodiesCoverTheirOutline) {
  for (const int side : {1, 4}) {
    Scene scene;
    scene.addStrand({{5, 5, 5}, {5, 5.1f, 5}});  // out of sight
    TriangleMesh ball = makeIcosphere(24);
    for (Vec3d& p : ball.points) p = p * 0.1;
    scene.solids = {solidMeshOf(ball)};
    scene.places = {{{0.02, -0.01, 0}, {}}};
    const double scale = pixelsPerMetre(scene.camera);
    const double angle = std::asin(0.1), area = std::numbers::pi * std::pow(std::tan(angle) * scale, 2);
    const double found = covered(draw(gpu(), scene, {kWidth, kHeight, side}, silhouette()).light);
    EXPECT_NEAR(found, area, 0.01 * area) << side;
  }
}

// A sheet of white hair before or behind a ball that is black.
TEST_F(HairRendererTest, TheNearerIsSeen) {
  const auto lightOf = [&](float depth) {
    Scene scene;
    for (int h = 0; h < 100; ++h) {
      const float y = 0.001f * static_cast<float>(h - 50);
      scene.addStrand({{-0.1f, y, depth}, {0.1f, y, depth}});
    }
    scene.width = 0.0015;
    TriangleMesh ball = makeIcosphere(12);
    for (Vec3d& p : ball.points) p = p * 0.1;
    scene.solids = {solidMeshOf(ball)};
    scene.places = {{{}, {}}};
    Look look = *lookByName("white");
    look.solid = look.backMiddle = look.backEdge = {};
    return meanLight(draw(gpu(), scene, {kWidth, kHeight, 2}, look).light);
  };
  const double before = lightOf(0.15f), behind = lightOf(-0.15f);
  EXPECT_GT(before, 0.05);
  EXPECT_LT(behind, 0.1 * before);
}

// The sheet that is seen is darker with another between it and the light.
TEST_F(HairRendererTest, HairThrowsShadowsOnHair) {
  const auto lightOf = [&](bool hasShade) {
    Scene scene;
    scene.width = 0.0015;
    const auto sheet = [&](Vec3f middle, float size) {
      for (int h = 0; h < 200; ++h) {
        const float y = size * (static_cast<float>(h) / 100 - 1);
        scene.addStrand({middle + Vec3f{-size, y, 0}, middle + Vec3f{0, y, 0}, middle + Vec3f{size, y, 0}});
      }
    };
    sheet({0, 0, 0}, 0.05f);
    // Towards the key light, out of the picture: the camera sees little more than the first.
    if (hasShade) sheet({-0.14f, 0.16f, 0.16f}, 0.09f);
    scene.camera.fieldOfView = 0.08;
    Look look;
    look.rim = look.skyAbove = look.skyBelow = look.backMiddle = look.backEdge = {};
    return meanLight(draw(gpu(), scene, {kWidth, kHeight, 2}, look).light);
  };
  const double open = lightOf(false), shaded = lightOf(true);
  EXPECT_GT(open, 0.01);
  EXPECT_LT(shaded, 0.6 * open);
}

TEST_F(HairRendererTest, SkylightIsLessWithinHair) {
  Scene scene = headScene(400);
  scene.width = 0.003;
  Look look = *lookByName("white");
  look.key = look.rim = look.backMiddle = look.backEdge = {};
  const double dense = meanLight(draw(gpu(), scene, {kWidth, kHeight, 2}, look).light);
  look.shadowOpacity = 0;
  const double open = meanLight(draw(gpu(), scene, {kWidth, kHeight, 2}, look).light);
  EXPECT_LT(dense, 0.8 * open);
}

// 64-bit atomics or two passes, texels or storage, in one part or in bands, again.
TEST_F(HairRendererTest, EveryPathGivesTheSameBits) {
  const Scene scene = headScene();
  for (const int side : {1, 2, 3, 4}) {
    SCOPED_TRACE(side);
    const PictureSize size{kWidth, kHeight, side};
    const std::vector<std::uint32_t> shown = draw(gpu(), scene, size).shown;
    EXPECT_GT(std::ranges::count_if(shown, [&](std::uint32_t pixel) { return (pixel & 0xff) > 60; }), 1000);
    EXPECT_EQ(draw(gpu(), scene, size).shown, shown) << "again";
    PictureSize bands = size;
    bands.mostBytes = 8 * 16 * kWidth * 7;
    EXPECT_EQ(draw(gpu(), scene, bands).shown, shown) << "in bands";
    const auto narrow = gpu::Device::open("", {.withoutAtomicInt64 = true, .mostTexelRecords = 16});
    ASSERT_TRUE(narrow) << narrow.error().message;
    EXPECT_FALSE((*narrow)->properties().hasAtomicInt64);
    EXPECT_EQ(draw(**narrow, scene, size).shown, shown) << "without 64-bit atomics and texels";
  }
}

TEST_F(HairRendererTest, MomentsAreAveraged) {
  const Scene scene = headScene();
  const PictureSize size{kWidth, kHeight, 2};
  const std::vector<float> one = draw(gpu(), scene, size).light,
                           three = draw(gpu(), scene, size, {}, 3).light;
  for (std::size_t i = 0; i < one.size(); ++i) ASSERT_NEAR(three[i], one[i], 1e-5f * (1 + one[i]));
}

double toned(double light, const Look& look) {
  const double x = light * look.exposure;
  const double film = std::clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
  return 255 * (film <= 0.0031308 ? 12.92 * film : 1.055 * std::pow(film, 1 / 2.4) - 0.055);
}

// As render_filter.comp: of three colours a pixel.
std::vector<double> filtered(const std::vector<double>& light, int width, int height) {
  std::vector<double> all;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c) {
        double sum = 0;
        for (int k = 0; k < 9; ++k) {
          const int dx = k % 3 - 1, dy = k / 3 - 1;
          const int nearX = std::clamp(x + dx, 0, width - 1), nearY = std::clamp(y + dy, 0, height - 1);
          sum += (dx == 0 ? 0.8 : 0.1) * (dy == 0 ? 0.8 : 0.1) *
                 light[static_cast<std::size_t>(3 * (nearY * width + nearX) + c)];
        }
        all.push_back(sum);
      }
  return all;
}

// Samples are even chances: more of them give the same picture with less noise. A pixel of the others is a
// block of `many`.
TEST_F(HairRendererTest, MoreSamplesAreTheSamePictureWithLessNoise) {
  Scene scene = headScene(6000);
  scene.width = widthOfHairs(6000);
  scene.camera.fieldOfView =
      2 * std::atan(kHeight / 2.0 / 800);  // a pixel is a millimetre, as in a picture of a head
  constexpr int kTimes = 4;
  const Look look;
  const std::vector<float> many = draw(gpu(), scene, {kWidth * kTimes, kHeight * kTimes, 4}, look).light;
  std::vector<double> means(std::size_t{3} * kWidth * kHeight);
  for (std::size_t i = 0; i < many.size(); ++i) {
    const std::size_t x = i / 3 % (kWidth * kTimes) / kTimes, y = i / 3 / (kWidth * kTimes) / kTimes;
    means[3 * (y * kWidth + x) + i % 3] += many[i] / (kTimes * kTimes);
  }
  const std::vector<double> exact = filtered(means, kWidth, kHeight);
  std::vector<double> rms;
  for (const int side : {2, 4}) {
    const std::vector<float> few = draw(gpu(), scene, {kWidth, kHeight, side}, look).light;
    double squares = 0, sum = 0, squaresOfBox = 0;
    int count = 0;
    for (std::size_t pixel = 0; pixel < exact.size(); pixel += 3) {
      const double shown = toned(few[pixel], look), difference = shown - toned(exact[pixel], look);
      squares += difference * difference;
      squaresOfBox += std::pow(shown - toned(means[pixel], look), 2);
      sum += difference;
      count += std::abs(difference) > 0.5;  // over the hair
    }
    EXPECT_GT(count, 5000);
    rms.push_back(std::sqrt(squares / std::max(count, 1)));
    RecordProperty(side == 2 ? "rms_2" : "rms_4", std::to_string(rms.back()));
    EXPECT_LT(std::abs(sum) / std::max(count, 1), 1.5) << side;
    EXPECT_LT(squares, 0.9 * squaresOfBox) << "it is filtered; " << side;
  }
  // Half as much, were samples independent; nearer ones are of the same hair.
  EXPECT_LT(rms[1], 0.6 * rms[0]);
}

TEST_F(HairRendererTest, SizesOutOfTheirRangeAreRefused) {
  auto strands = StrandPoints::create(gpu(), {0, 2});
  ASSERT_TRUE(strands);
  for (const PictureSize size :
       {PictureSize{0, 10, 2}, {10, 0, 2}, {10, 10, 0}, {10, 10, 5}, {20000, 10, 1}}) {
    const auto renderer =
        HairRenderer::create(gpu(), {strands->points(), strands->firstPoint(), 0.001}, {}, size, {});
    ASSERT_FALSE(renderer);
    expectParts(renderer.error().message, {"pixels", "at most 16384"});
  }
}

// Of the scene with the default look.
std::vector<std::uint32_t> pictureOf(gpu::Device& device, const Scene& scene, const PictureSize& size,
                                     const std::vector<std::uint32_t>& cutBeyond = {}) {
  auto strands = StrandPoints::create(device, scene.firstPoint);
  EXPECT_TRUE(strands->setPose(scene.points, 1, cutBeyond));
  auto renderer = HairRenderer::create(device, {strands->points(), strands->firstPoint(), scene.width},
                                       scene.solids, size, {});
  EXPECT_TRUE(renderer) << renderer.error().message;
  EXPECT_TRUE(renderer->setFrame(scene.camera, scene.bounds, scene.places));
  auto recorder = gpu::Recorder::create(device, "picture");
  EXPECT_TRUE(recorder->begin());
  renderer->record(*recorder, true);
  EXPECT_TRUE(recorder->submitAndWait());
  return *renderer->picture();
}

// Where a strand is cut neither hair nor its shadow is seen.
TEST_F(HairRendererTest, NothingIsDrawnAcrossACut) {
  Scene scene;
  scene.addStrand({{-0.3f, 0, 0}, {-0.25f, 0, 0}, {0.25f, 0, 0}, {0.3f, 0, 0}});
  scene.width = 0.02;
  const auto seen = [&](const std::vector<std::uint32_t>& cutBeyond) {
    return pictureOf(gpu(), scene, {kWidth, kHeight, 2}, cutBeyond);
  };
  const auto whole = seen({}), cut = seen({1}), none = seen({0, 1, 2});
  const auto countOf = [&](const std::vector<std::uint32_t>& picture) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < picture.size(); ++i) count += picture[i] != none[i];
    return static_cast<double>(count);
  };
  EXPECT_GT(countOf(whole), 50);
  EXPECT_NEAR(countOf(cut) / countOf(whole), 0.1 / 0.6, 0.06);
  const std::size_t middle = static_cast<std::size_t>(kHeight / 2) * kWidth + kWidth / 2;
  EXPECT_NE(whole[middle], none[middle]);
  EXPECT_EQ(cut[middle], none[middle]);
}

// A preview is the same picture, but for noise: as bright, with hair where hair is.
TEST_F(HairRendererTest, APreviewLooksLikeThePicture) {
  const Scene scene = headScene();
  PictureSize size{kWidth, kHeight, 2};
  const auto full = pictureOf(gpu(), scene, size);
  size.isPreview = true;
  const auto preview = pictureOf(gpu(), scene, size);
  double sum = 0, squares = 0;
  for (std::size_t i = 0; i < full.size(); ++i)
    for (const int shift : {0, 8, 16}) {
      const double difference = static_cast<double>(preview[i] >> shift & 255) - (full[i] >> shift & 255);
      sum += difference / (3.0 * static_cast<double>(full.size()));
      squares += difference * difference / (3.0 * static_cast<double>(full.size()));
    }
  EXPECT_LT(std::abs(sum), 1.0);
  EXPECT_LT(std::sqrt(squares), 10.0);
  EXPECT_EQ(pictureOf(gpu(), scene, size), preview) << "the same bits";
}

// A hair's pigment is its place among the look's: between two of them what absorbs light is mixed.
TEST_F(HairRendererTest, PigmentsAreMixedBetweenNeighbours) {
  Scene scene;
  scene.addStrand({{-0.2f, 0, 0}, {0.2f, 0, 0}});
  scene.width = 0.1;
  const auto lightAt = [&](float place, std::vector<Absorption> pigments) {
    auto strands = StrandPoints::create(gpu(), scene.firstPoint);
    EXPECT_TRUE(strands->setPose(scene.points, 1));
    Look look;
    look.pigments = std::move(pigments);
    auto renderer = HairRenderer::create(gpu(), {strands->points(), strands->firstPoint(), scene.width}, {},
                                         {kWidth, kHeight, 1}, look);
    EXPECT_TRUE(renderer->setFrame(scene.camera, scene.bounds, {}));
    EXPECT_TRUE(renderer->setPigments(std::vector<float>{place}));
    auto recorder = gpu::Recorder::create(gpu(), "picture");
    EXPECT_TRUE(recorder->begin());
    renderer->record(*recorder, true);
    EXPECT_TRUE(recorder->submitAndWait());
    return *renderer->light();
  };
  const Absorption red = absorptionOfColour({0.8, 0.1, 0.1}), green = absorptionOfColour({0.1, 0.8, 0.1}),
                   blue = absorptionOfColour({0.1, 0.1, 0.8});
  const std::vector<Absorption> three = {red, green, blue};
  EXPECT_EQ(lightAt(0, three), lightAt(0, {red, blue}));
  EXPECT_EQ(lightAt(0.5, three), lightAt(1, {red, green}));
  EXPECT_EQ(lightAt(0.75, three), lightAt(0.5, {green, blue}));
  EXPECT_EQ(lightAt(1, three), lightAt(1, {red, blue}));
  EXPECT_NE(lightAt(0.5, three), lightAt(0.5, {red, blue}));
}

// Under a ball the ground is darker than beside it; far away it is what is behind all.
TEST_F(HairRendererTest, AGroundTakesShadowsAndFades) {
  Scene scene = headScene(1);
  scene.camera = {.eye = {0, 0.4, 1.2}, .target = {0, -0.1, 0}};
  const auto lightOf = [&](bool hasBall) {
    Scene with = scene;
    if (!hasBall) with.solids.clear(), with.places.clear();
    with.solids.push_back(groundOf(2.5));
    with.places.push_back({{0, -0.3, 0}, {}});
    return draw(gpu(), with, {kWidth, kHeight, 2}).light;
  };
  const auto with = lightOf(true), without = lightOf(false);
  const auto none = draw(gpu(), scene, {kWidth, kHeight, 2}).light;
  int darker = 0, lighter = 0;
  for (std::size_t pixel = 3 * kWidth * kHeight / 2; pixel < with.size(); pixel += 3) {  // the ground's half
    darker += with[pixel] < 0.8f * without[pixel];
    lighter += with[pixel] > 1.2f * without[pixel];
  }
  EXPECT_GT(darker, 200);
  EXPECT_LT(lighter, darker / 4);
  // Ten rows below the top the ground is seen 2.2 m from its middle, of 2.5, and at half the height near it.
  const auto ofRow = [&](int row) {
    double sum = 0;
    for (int x = 0; x < kWidth; ++x) {
      const std::size_t at = 3 * (static_cast<std::size_t>(row) * kWidth + x);
      sum += std::abs(without[at] - none[at]) / kWidth;
    }
    return sum;
  };
  EXPECT_LT(ofRow(10), 0.2 * ofRow(60)) << ofRow(10) << " " << ofRow(60);
  EXPECT_EQ(ofRow(0), 0) << "beyond it";
}

// A square before the camera, its front or its back: of cloth both are lit, and in its own colour.
TEST_F(HairRendererTest, TheBackOfClothIsLitAsItsFront) {
  const auto lightOf = [&](bool isCloth, bool isBack, Vec3d cloth = {0.4, 0.4, 0.4}) {
    Scene scene;
    scene.addStrand({{5, 5, 5}, {5, 5.1f, 5}});  // out of sight
    TriangleMesh square{{{-0.1, -0.1, 0}, {0.1, -0.1, 0}, {0.1, 0.1, 0}, {-0.1, 0.1, 0}},
                        {{0, 1, 2}, {0, 2, 3}}};
    for (auto& t : square.triangles)
      if (isBack) std::swap(t[1], t[2]);
    scene.solids = {solidMeshOf(square)};
    scene.solids[0].isCloth = isCloth;
    scene.places = {{{}, {}}};
    Look look;
    look.solid = {0.4, 0.4, 0.4}, look.cloth = cloth;
    look.rim = look.skyAbove = look.skyBelow = look.backMiddle = look.backEdge = {};
    return meanLight(draw(gpu(), scene, {kWidth, kHeight, 2}, look).light);
  };
  const double front = lightOf(true, false);
  EXPECT_GT(front, 0.01);
  EXPECT_NEAR(lightOf(true, true), front, 0.02 * front);
  EXPECT_NEAR(lightOf(false, false), front, 0.02 * front);
  EXPECT_LT(lightOf(false, true), 0.1 * front);
  EXPECT_NEAR(lightOf(true, true, {0.1, 0.1, 0.1}), front / 4, 0.05 * front);
}

// Of two strands the one that is longer than at rest has the last colour, and hairs that follow take theirs.
TEST_F(HairRendererTest, StretchIsTheColourOfTheLongestEdge) {
  Scene scene;
  scene.addStrand({{0, 0, 0}, {0, -0.01f, 0}, {0, -0.02f, 0}});
  scene.addStrand({{0.1f, 0, 0}, {0.1f, -0.01f, 0}, {0.1f, -0.02f, 0}});
  const std::vector<Vec3d> rest(scene.points.begin(), scene.points.end());
  scene.points[4].y = -0.01025f;  // 2.5 % longer, then 2.5 % shorter
  auto strands = StrandPoints::create(gpu(), scene.firstPoint);
  ASSERT_TRUE(strands->setPose(scene.points, 1));
  const std::vector<std::uint32_t> strandOf{1, 0, 1};
  auto hairs = createFilled(gpu(), std::vector<layout::DrawnHair>(3), "hairs");
  auto stretch = StretchColours::create(gpu(), strands->points(), rest, scene.firstPoint, strandOf, *hairs);
  ASSERT_TRUE(stretch) << stretch.error().message;
  const auto pigments = [&](double most) {
    auto recorder = gpu::Recorder::create(gpu(), "stretch");
    EXPECT_TRUE(recorder->begin());
    stretch->record(*recorder, most);
    EXPECT_TRUE(recorder->submitAndWait());
    std::vector<float> found;
    const auto drawn = downloadAll<layout::DrawnHair>(*hairs, 3);
    for (const layout::DrawnHair& hair : *drawn) found.push_back(hair.pigment);
    return found;
  };
  const auto half = pigments(0.05);
  EXPECT_NEAR(half[0], 0.5, 1e-3);
  EXPECT_NEAR(half[1], 0, 1e-3);
  EXPECT_NEAR(half[2], 0.5, 1e-3);
  EXPECT_EQ(pigments(0.01)[0], 1) << "no more than all";
  ASSERT_TRUE(strands->setPose(scene.points, 1, std::vector<std::uint32_t>{3}));
  EXPECT_NEAR(pigments(0.05)[0], 0, 1e-3) << "an edge at a cut does not count";
}

}  // namespace
}  // namespace ringlet::test::hair_renderer_test

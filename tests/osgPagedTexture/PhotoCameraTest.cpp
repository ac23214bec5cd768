// SPDX-License-Identifier: MIT
#include "CapturedWall.h"

#include <osgPagedTexture/ImageFile.h>
#include <osgPagedTexture/ModelPhotos.h>
#include <osgPagedTexture/PhotoWarp.h>
#include <osgPagedTexture/PictureFile.h>

#include <support/TemporaryFolder.h>

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include <cmath>
#include <cstdlib>

using namespace osgPagedTexture;

namespace
{

glm::dvec2 pixelOf(const PhotoCamera& camera, const glm::dvec3& place)
{
    const glm::dvec3 seen = camera.project(place);
    return glm::dvec2(seen) / seen.z;
}

TEST(PhotoCameraTest, theCameraOfAPhotographIsFoundFromCoordinates)
{
    std::vector<PhotoPoint> points;
    for (int i = 0; i < 400; ++i)
    {
        const glm::dvec3 place = CapturedWall::pointAt(0.1 * (i % 20), 0.07 * (i / 20));
        points.push_back({place, CapturedWall::project(0, place) * glm::dvec2(640, 512)});
    }
    const PhotoCamera camera = fitCamera(points);
    EXPECT_EQ(camera.kind, PhotoCamera::Kind::Perspective);
    EXPECT_LT(camera.error, 1e-6);
    // Also where it has not seen anything.
    const glm::dvec3 other = CapturedWall::pointAt(3.1, 2.4);
    EXPECT_LT(glm::distance(pixelOf(camera, other),
                            CapturedWall::project(0, other) * glm::dvec2(640, 512)),
              1e-5);
    EXPECT_GT(camera.project(other).z, 0.0);
    EXPECT_LT(camera.project({1.0, 0.8, 100.0}).z, 0.0);
}

TEST(PhotoCameraTest, aFlatWallGivesTheViewOfItsPlane)
{
    std::vector<PhotoPoint> points;
    for (int i = 0; i < 100; ++i)
    {
        const glm::dvec3 place(0.2 * (i % 10), 0.2 * (i / 10), 0.5);
        points.push_back({place, CapturedWall::project(1, place) * glm::dvec2(640, 512)});
    }
    const PhotoCamera camera = fitCamera(points);
    EXPECT_EQ(camera.kind, PhotoCamera::Kind::Plane);
    EXPECT_LT(camera.error, 1e-6);
}

TEST(PhotoCameraTest, coordinatesThatAreNoViewGetWhatFitsBest)
{
    std::vector<PhotoPoint> points;
    for (int i = 0; i < 400; ++i)
    {
        const glm::dvec3 place = CapturedWall::pointAt(0.1 * (i % 20), 0.07 * (i / 20));
        points.push_back({place, {200.0 * std::sin(9.0 * place.x), 100.0 * place.y}});
    }
    const PhotoCamera camera = fitCamera(points);
    EXPECT_EQ(camera.kind, PhotoCamera::Kind::Affine);
    EXPECT_GT(camera.error, 4.0);
    EXPECT_TRUE(std::isfinite(camera.error));
    for (const auto& few : {std::vector<PhotoPoint>(), std::vector<PhotoPoint>(2, points[0])})
        EXPECT_EQ(fitCamera(few).kind, PhotoCamera::Kind::Affine);
}

TEST(PhotoCameraTest, aNeighbourSeenByThePhotographsCameraGoesOnWhereItEnds)
{
    const support::TemporaryFolder folder;
    const CapturedWall wall(40, 30, 320, 256, true);
    const ModelPhotos model = readModelPhotos(wall.write(folder.getPath().string()), true);
    ASSERT_EQ(model.photos.size(), 4u);
    const PhotoCamera camera = fitCamera(pointsOf(model.photos[0]));
    EXPECT_LT(camera.error, 0.01); // Numbers of the file are floats.
    const Pixels layer = warpPhoto(model.photos[1], wall.photograph(1), camera, 320, 256);
    // What camera 1 sees of the other half of the wall is in its photograph as well.
    const Pixels own = wall.photograph(0);
    double sum = 0.0;
    std::size_t count = 0;
    for (int y = 0; y < 256; ++y)
        for (int x = 0; x < 320; ++x)
            if (layer.row(y)[4 * x + 3] != 0)
                for (int c = 0; c < 3; ++c, ++count)
                    sum += std::abs(int(layer.row(y)[4 * x + c]) - int(own.row(y)[3 * x + c]));
    ASSERT_GT(count, 3u * 320u * 256u / 10u);
    // Joints of bricks are as narrow as pixels; a shift by a pixel gives about 9.
    EXPECT_LT(sum / double(count), 4.5);
}

TEST(PhotoCameraTest, layersAreThePagesOfAFile)
{
    const support::TemporaryFolder folder;
    Pixels below(20, 10, 3), above(20, 10, 4);
    above.row(9)[3] = 255;
    writeLayers(folder.file("layers.tif"), {{"below", below}, {"above", above}});
    EXPECT_EQ(readImageInfo(folder.file("layers.tif")).width, 20);
    EXPECT_THROW(writeLayers(folder.file("none.tif"), {}), ImageError);
}

} // namespace

// SPDX-License-Identifier: MIT
#include "PagedScenes.h"

#include <osgPagedTexture/PagedOptions.h>

#include <osg/Geometry>
#include <osgDB/WriteFile>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>
#include <thread>

namespace paged
{

osg::ref_ptr<osg::Image> makePicture(int width, int height, int channels, unsigned int seed)
{
    const GLenum formats[] = {GL_LUMINANCE, GL_LUMINANCE_ALPHA, GL_RGB, GL_RGBA};
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(width, height, 1, formats[channels - 1], GL_UNSIGNED_BYTE, 1);
    std::mt19937 random(seed);
    const double phase = double(seed % 7);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < channels; ++c)
            {
                const double wave = std::sin(0.02 * x * (c + 1) + phase) * std::cos(0.03 * y + c);
                const double value = 128.0 + 80.0 * wave + double(random() % 32) - 16.0;
                image->data(x, y)[c] = static_cast<unsigned char>(std::clamp(value, 0.0, 255.0));
            }
    return image;
}

std::string writePicture(const support::TemporaryFolder& folder, const std::string& name, int width,
                         int height, int channels, unsigned int seed)
{
    const std::string file = folder.file(name);
    EXPECT_TRUE(osgDB::writeImageFile(*makePicture(width, height, channels, seed), file)) << file;
    return file;
}

osg::ref_ptr<osg::Texture2D> makeTexture(const std::string& file)
{
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(1, 1, 1, GL_RGB, GL_UNSIGNED_BYTE);
    image->setFileName(file);
    image->setWriteHint(osg::Image::EXTERNAL_FILE);
    osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(image);
    texture->setWrap(osg::Texture::WRAP_S, osg::Texture::REPEAT);
    texture->setWrap(osg::Texture::WRAP_T, osg::Texture::REPEAT);
    return texture;
}

osg::ref_ptr<osg::Geode> makeSquare(const osg::Vec3& center, osg::Texture2D* texture, float repeat)
{
    osg::ref_ptr<osg::Geometry> square = osg::createTexturedQuadGeometry(
        center - osg::Vec3(1.0f, 0.0f, 1.0f), osg::Vec3(2.0f, 0.0f, 0.0f),
        osg::Vec3(0.0f, 0.0f, 2.0f), repeat, repeat);
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(square);
    if (texture)
        geode->getOrCreateStateSet()->setTextureAttributeAndModes(0, texture);
    geode->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
    return geode;
}

std::string writeSquare(const support::TemporaryFolder& folder, const std::string& picture)
{
    const std::string file = folder.file("square.osgt");
    EXPECT_TRUE(osgDB::writeNodeFile(*makeSquare({0.0f, 4.0f, 0.0f}, makeTexture(picture)), file));
    return file;
}

std::string writeCity(const support::TemporaryFolder& folder, int rows, int columns, int side)
{
    osg::ref_ptr<osg::Group> city = new osg::Group;
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column)
        {
            const int number = row * columns + column;
            const std::string name = "house" + std::to_string(number) + ".png";
            writePicture(folder, name, side, side, 3, unsigned(number));
            city->addChild(makeSquare(osg::Vec3(2.5f * float(column) - 1.25f * float(columns - 1),
                                                4.0f + 8.0f * float(row), 1.5f * float(row)),
                                      makeTexture(name)));
        }
    const std::string file = folder.file("city.osgt");
    EXPECT_TRUE(osgDB::writeNodeFile(*city, file));
    return file;
}

osg::ref_ptr<osgPagedTexture::PagedScene> read(const std::string& model,
                                               const std::string& settings)
{
    osg::ref_ptr<osgPagedTexture::PagedScene> scene = new osgPagedTexture::PagedScene;
    osgPagedTexture::PagedSettings parsed;
    parsed.cache = "off";
    for (const std::string& error : parsePagedOptions(parsed, settings))
        ADD_FAILURE() << error;
    scene->setSettings(parsed);
    osgDB::ReaderWriter::ReadResult result = scene->readModel(model);
    EXPECT_TRUE(result.validNode()) << model << ": " << result.message();
    return scene;
}

support::CameraSpec lookAlong(const osg::Vec3d& eye)
{
    return support::CameraSpec::perspective(eye, eye + osg::Vec3d(0.0, 1.0, 0.0),
                                            osg::Vec3d(0.0, 0.0, 1.0), 50.0, 4.0 / 3.0, 0.1, 1e4);
}

osg::ref_ptr<osg::Image> settle(support::HeadlessViewer& viewer, osgPagedTexture::PagedScene& scene,
                                const support::CameraSpec& camera, int width, int height)
{
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    // The need of a frame is known in the next one, and GL's abilities after the first.
    for (int calm = 0; calm < 4; calm = scene.isAtRest() ? calm + 1 : 0)
    {
        viewer.render(&scene, camera, width, height);
        if (std::chrono::steady_clock::now() > end)
        {
            ADD_FAILURE() << "not at rest after a minute";
            break;
        }
        if (!scene.isAtRest())
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return viewer.render(&scene, camera, width, height);
}

double countOf(const osgPagedTexture::PagedScene& scene, const std::string& name)
{
    const std::vector<osgMultiRender::Plan> plans = scene.getPlans();
    const auto found = plans.at(0).counts.find(name);
    EXPECT_NE(found, plans.at(0).counts.end()) << name;
    return found == plans.at(0).counts.end() ? -1.0 : found->second;
}

} // namespace paged

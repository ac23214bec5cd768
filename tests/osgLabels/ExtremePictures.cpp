// SPDX-License-Identifier: MIT
#include "ExtremePictures.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace labelScene
{

namespace
{

constexpr double Nothing = std::numeric_limits<double>::quiet_NaN();

/// The four channels of a pixel.
const float* at(const osg::Image& picture, int x, int y)
{
    return reinterpret_cast<const float*>(picture.data(x, y));
}

bool isBackground(const float* pixel)
{
    const osg::Vec4 background = support::HeadlessSettings().clearColor;
    return std::equal(background.ptr(), background.ptr() + 3, pixel,
                      [](float a, float b) { return std::abs(a - b) <= 0.5f / 255.0f; });
}

void expectInkOnTheModel(const InkPictures& pictures, const std::string& name)
{
    int beside = 0, lighter = 0;
    for (int y = 0; y < Height; ++y)
        for (int x = 0; x < Width; ++x)
        {
            const float* const without = at(*pictures.without, x, y);
            const float* const with = at(*pictures.with, x, y);
            beside += isBackground(without) && !isBackground(with);
            for (int channel = 0; channel < 3; ++channel)
                lighter += with[channel] > without[channel] + 2.0f / 255.0f;
        }
    EXPECT_EQ(beside, 0) << name << ": ink beside the model";
    EXPECT_EQ(lighter, 0) << name << ": black ink makes nothing lighter";
}

} // namespace

osg::ref_ptr<osg::Geode> board(const std::string& text)
{
    return named(text,
                 rectangle({-1.2f, 0, -0.5f}, {2.4f, 0, 0}, {0, 0, 1}, {0.9f, 0.9f, 0.8f, 1}));
}

osg::ref_ptr<osg::Geode> pipe(const std::string& name, double left, double length, float radius)
{
    constexpr int sides = 32;
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    osg::ref_ptr<osg::DrawElementsUShort> strip = new osg::DrawElementsUShort(GL_TRIANGLE_STRIP);
    for (int i = 0; i <= sides; ++i)
    {
        const double angle = 2.0 * osg::PI * i / sides;
        for (double x : {left, left + length})
        {
            vertices->push_back(osg::Vec3(float(x), float(radius * std::cos(angle)),
                                          float(radius * std::sin(angle))));
            strip->push_back(GLushort(vertices->size() - 1));
        }
    }
    geometry->setVertexArray(vertices);
    const osg::Vec4 color(0.9f, 0.85f, 0.8f, 1.0f);
    geometry->setColorArray(new osg::Vec4Array(1, &color), osg::Array::BIND_OVERALL);
    geometry->addPrimitiveSet(strip);
    return named(name, geometry);
}

support::CameraSpec lookFrom(const osg::Vec3d& eye, const osg::Vec3d& center, double distance)
{
    return support::CameraSpec::perspective(eye, center, {0, 0, 1}, 40.0, double(Width) / Height,
                                            distance / 100.0, distance * 100.0);
}

Picture renderNumbers(osg::Node& node, const std::string& name, const support::CameraSpec& camera)
{
    viewer().getViewer().getCamera()->getGraphicsContext()->makeCurrent();
    const Picture picture = viewer().renderFloat(&node, camera, Width, Height, 2);
    if (!picture)
        return nullptr;
    keep(picture, "labelExtreme." + name);
    const float* const values = at(*picture, 0, 0);
    EXPECT_TRUE(std::all_of(values, values + 4 * Width * Height,
                            [](float value) { return std::isfinite(value); }))
        << name << " has pixels that are no numbers";
    return picture;
}

double InkPictures::modelShare() const
{
    if (!without)
        return Nothing;
    int count = 0;
    for (int y = 0; y < Height; ++y)
        for (int x = 0; x < Width; ++x)
            count += !isBackground(at(*without, x, y));
    return double(count) / (Width * Height);
}

double InkPictures::inkShare() const
{
    return with && without ? changedShare(*with, *without) : Nothing;
}

InkPictures drawInk(osg::Node* model, const std::string& name, const support::CameraSpec& camera,
                    const std::string& settings)
{
    const auto scene = labelled(model, settings);
    InkPictures pictures;
    pictures.with = renderNumbers(*scene, name, camera);
    EXPECT_EQ(countOf(*scene, "variants.failed"), 0.0) << name;
    pictures.without = renderNumbers(*model, name + ".bare", camera);
    if (pictures.with && pictures.without)
        expectInkOnTheModel(pictures, name);
    return pictures;
}

} // namespace labelScene

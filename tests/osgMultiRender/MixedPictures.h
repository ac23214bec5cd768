// SPDX-License-Identifier: MIT
// What tests of MixedScenes share.
#pragma once

#include "osgMultiRender/MixTruth.h"
#include "osgMultiRender/RenderingScenes.h"

#include <osgMultiRender/Import.h>
#include <osgMultiRender/MixedScene.h>
#include <support/CompareImage.h>
#include <support/NotifyCapture.h>

#include <iostream>
#include <limits>

/// A scene of built-in renderings over the sample model, and the truth about it.
class MixedPictures : public testing::Test
{
protected:
    static constexpr int Size = 256;
    static constexpr double Infinity = std::numeric_limits<double>::infinity();

    void SetUp() override { OSGKITS_NEED_GL(_viewer); }

    static support::HeadlessSettings makeSettings()
    {
        support::HeadlessSettings settings;
        settings.width = settings.height = Size;
        return settings;
    }

    void add(const std::string& name, const osgMultiRender::MixRange& range)
    {
        _names.push_back(name);
        _ranges.push_back(range);
        _scene->addRendering(osgMultiRender::importNamed(name), range);
    }

    void setKeys(const std::vector<osg::Vec3d>& points,
                 osgMultiRender::KeyMode mode = osgMultiRender::KeyMode::Points)
    {
        _scene->setKeyPoints(points, mode);
        std::vector<glm::dvec3> places;
        for (const osg::Vec3d& point : points)
            places.emplace_back(point.x(), point.y(), point.z());
        _points = osgMultiRender::KeyPoints(places, mode);
    }

    osg::ref_ptr<osg::Image> draw(unsigned int frames = 1)
    {
        if (!_scene->getNumChildren())
            _scene->addChild(_model);
        return _viewer.renderFloat(_scene, _camera, Size, Size, frames);
    }

    void expectTruth(const std::string& name, unsigned int frames = 1,
                     const osgMultiRender::MixRules& rules = osgMultiRender::MixRules())
    {
        MixTruth truth(_viewer, _model, _camera, Size);
        for (const std::string& rendering : _names)
            truth.add(makeRenderingState(*osgMultiRender::findBuiltInRendering(rendering)));
        _scene->setRules(rules);
        support::NotifyCapture capture;
        const osg::ref_ptr<osg::Image> picture = draw(frames);
        EXPECT_EQ(capture.takeWarnings(), support::NotifyCapture::Lines());
        ASSERT_TRUE(picture);
        support::writeImage(*picture, name);
        const MixTruth::Difference difference =
            truth.compare(*picture, _points, osgMultiRender::MixWeights(_ranges, rules));
        std::cout << name << ": " << difference.covered << " pixels, " << difference.mixed
                  << " mixed, worst " << difference.worst * 255.0 << "/255, over "
                  << difference.over << "\n";
        EXPECT_GT(difference.covered, Size * Size / 8);
        EXPECT_GT(difference.mixed, difference.covered / 20);
        EXPECT_EQ(difference.over, 0);
    }

    /// The mouse goes to a place of the window, -1 to 1.
    osgGA::EventQueue& aim(double x, double y)
    {
        osgGA::EventQueue& queue = *_viewer.getViewer().getEventQueue();
        queue.setMouseInputRange(-1.0f, -1.0f, 1.0f, 1.0f);
        queue.getCurrentEventState()->setMouseYOrientation(
            osgGA::GUIEventAdapter::Y_INCREASING_UPWARDS);
        queue.mouseMotion(float(x), float(y));
        return queue;
    }

    /// As if pressed at a place of the window, -1 to 1.
    void press(char key, float x = 0.0f, float y = 0.0f)
    {
        osgGA::EventQueue& queue = aim(x, y);
        queue.keyPress(key);
        queue.keyRelease(key);
        draw();
    }

    /// The left button, held with modifiers.
    void button(double x, double y, int modifiers)
    {
        aim(x, y).getCurrentEventState()->setModKeyMask(modifiers);
        _viewer.getViewer().getEventQueue()->mouseButtonPress(float(x), float(y), 1);
        draw();
    }

    void release(double x, double y)
    {
        _viewer.getViewer().getEventQueue()->mouseButtonRelease(float(x), float(y), 1);
        draw();
        _viewer.getViewer().getEventQueue()->getCurrentEventState()->setModKeyMask(0);
    }

    osg::Vec3d screenOf(const osg::Vec3d& point) const
    {
        return point * _camera.view * _camera.projection;
    }

    /// To a hundredth of a pixel: events have single precision.
    void expectUnder(const osg::Vec3d& point, double x, double y) const
    {
        EXPECT_NEAR(screenOf(point).x(), x, 0.02 / Size);
        EXPECT_NEAR(screenOf(point).y(), y, 0.02 / Size);
    }

    double count(const std::string& what) const
    {
        const std::vector<osgMultiRender::Plan> plans = _scene->getPlans();
        return plans.empty() ? -1.0 : plans.back().counts.at(what);
    }

    support::HeadlessViewer _viewer{makeSettings()};
    osg::ref_ptr<osg::Image> _image = makeSampleImage(64);
    osg::ref_ptr<osg::Node> _model = makeSampleModel(*_image);
    support::CameraSpec _camera = support::CameraSpec::perspective(
        {2.5, -8.0, 4.5}, {0.0, 0.0, -0.2}, {0, 0, 1}, 35.0, 1.0, 1.0, 30.0);
    osg::ref_ptr<osgMultiRender::MixedScene> _scene = new osgMultiRender::MixedScene;
    osgMultiRender::KeyPoints _points;
    std::vector<std::string> _names;
    std::vector<osgMultiRender::MixRange> _ranges;
};

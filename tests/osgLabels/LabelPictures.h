// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/LabelScene.h>

#include <support/CompareImage.h>
#include <support/HeadlessViewer.h>
#include <support/NotifyCapture.h>

#include <osg/Geode>
#include <osg/Geometry>
#include <osg/Group>

#include <gtest/gtest.h>

#include <string>

/// Pictures of labelled objects.
namespace labelScene
{

using Picture = osg::ref_ptr<osg::Image>;

constexpr int Width = 256, Height = 192;

/// Labels that are evaluated in full and can't be seen: their ink moves a channel by 1/255 at most.
extern const char* const Invisible;

/// Black letters on what they are on.
extern const char* const Plain;

/// Of this process; its headlight is off.
support::HeadlessViewer& viewer();

/// The fixture of tests that draw with it: warnings that no test takes are failures.
class PictureTest : public testing::Test
{
protected:
    void SetUp() override;

    support::NotifyCapture _notify;
};

/// A parallelogram of one colour, not lit, of 4 x 4 quads so that shading has vertices.
osg::ref_ptr<osg::Geometry> rectangle(const osg::Vec3& corner, const osg::Vec3& width,
                                      const osg::Vec3& height, const osg::Vec4& color);

/// The drawable in a Geode of that name.
osg::ref_ptr<osg::Geode> named(const std::string& name, osg::Drawable* drawable);

/// A box around `center`, not lit.
osg::ref_ptr<osg::Geode> box(const std::string& name, const osg::Vec3& center,
                             const osg::Vec3& halfExtents,
                             const osg::Vec4& color = osg::Vec4(0.8f, 0.8f, 0.7f, 1.0f));

/// A group without lighting, over the node if there is one.
osg::ref_ptr<osg::Group> unlit(osg::Node* node = nullptr);

/// A LabelScene over the node, without keys.
osg::ref_ptr<osgLabels::LabelScene> labelled(osg::Node* node,
                                             const std::string& settings = std::string());

/// Looks along +y at x from -4/3 to 4/3 and z from -1 to 1 of the plane y = 0, from 4 away.
support::CameraSpec fromFront(double aspect = double(Width) / Height);

/// As fromFront(), parallel.
support::CameraSpec parallel(double aspect = double(Width) / Height);

Picture render(osg::Node& node, const support::CameraSpec& camera = fromFront(), int width = Width,
               int height = Height, unsigned int frames = 2);

/// A number of the first plan; -1 where it lacks it.
double countOf(const osgLabels::LabelScene& scene, const std::string& name);

/// Decision and reason of the first plan on the labels: "dropped: nothing labelled is in view".
std::string decisionOf(const osgLabels::LabelScene& scene);

/// Pixels of a picture that differ by more than 2/255 from another one, as a share.
double changedShare(const osg::Image& actual, const osg::Image& other);

/// Writes it into build/images where OSGKITS_KEEP_IMAGES is set.
void keep(const osg::Image* image, const std::string& name);

/// Few pixels may differ by any amount: an edge that falls the other way by the last bit of a
/// coordinate. keep()s the actual one.
testing::AssertionResult areAlike(const osg::Image* actual, const osg::Image* expected,
                                  const std::string& name);

/// No channel of any pixel differs.
testing::AssertionResult areEqual(const osg::Image* actual, const osg::Image* expected,
                                  const std::string& name);

} // namespace labelScene

// SPDX-License-Identifier: MIT
#pragma once

#include <osgShadowVolume/LitScene.h>

#include <support/CompareImage.h>
#include <support/HeadlessViewer.h>

#include <osg/Geode>
#include <osg/Light>

#include <functional>
#include <string>

/// Pictures of a scene with a LitScene in it beside those of the same scene with a plain group.
namespace lit
{

constexpr int Width = 128, Height = 96;

using Lighting = osgShadowVolume::LitScene::Lighting;

/// Makes a scene; `kit` is the group that the scene is to put somewhere.
using Build = std::function<osg::ref_ptr<osg::Node>(osg::Group& kit)>;

/// The viewer of this process.
support::HeadlessViewer& viewer();

/// Looks at the origin from the front and a little above; 4 units across are seen.
support::CameraSpec camera();

/// A ball of radius 0.8 in a Geode; the Geode has no StateSet.
osg::ref_ptr<osg::Geode> ball(const osg::Vec3& center,
                              const osg::Vec4& color = osg::Vec4(1, 1, 1, 1));

/// Makes it transparent, sorted by depth, as osgdb_iv does.
void makeTransparent(osg::Node& node, bool nest = true);

/// A LightSource with its light on in `scope`.
osg::ref_ptr<osg::Node> lightSource(unsigned int number, const osg::Vec4& position,
                                    const osg::Vec4& color, osg::StateSet& scope);

osg::ref_ptr<osg::Image> picture(osg::Node& scene, unsigned int frames = 2);

osg::ref_ptr<osgShadowVolume::LitScene> litScene(Lighting lighting);

/// The only plan of a kit that was drawn once; its variants are all linked.
osgMultiRender::Plan planOf(const osgMultiRender::SurfaceGroup& kit);

/// The decision and reason on a subject, or "" where the plan does not name it.
std::string entryOf(const osgMultiRender::Plan& plan, const std::string& subject);

/// The scene looks the same with the kit (lighting=vertex) and with a plain group, and the kit drew
/// something by its programs. 2/255 on 99.9 % of the pixels; edges of depth-sorted things may
/// differ.
void expectSameAsStock(const Build& build, const std::string& name, unsigned int frames = 2);

/// Whether two pictures differ visibly: otherwise a test would prove nothing.
bool differ(const osg::Image& a, const osg::Image& b);

} // namespace lit

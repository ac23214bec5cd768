// SPDX-License-Identifier: MIT
#pragma once

#include "FeatureScenes.h"

#include <osg/Geode>
#include <osg/Geometry>
#include <osg/Light>
#include <osg/Texture2D>

/// What the feature scenes are made of.
namespace feature
{

/// The vertex data of the subject.
struct Subject
{
    enum class Colors
    {
        None,
        Overall,
        PerPrimitiveSet,
        PerVertex
    };

    enum class Normals
    {
        Unit,
        Uneven, ///< Lengths from 0.4 to 2.
        Zero,
        None
    };

    Colors colors = Colors::None;
    Normals normals = Normals::Unit;
    bool open = false; ///< Half of the torus, so that its inside is seen.
};

/// A torus of 24x12 quads around the origin: texture coordinates (s, t, r) on units 0 to 4, each
/// unit's differently scaled.
osg::ref_ptr<osg::Geometry> torus(const Subject& subject = Subject());

/// A square of 8x8 quads behind and below the torus.
osg::ref_ptr<osg::Geometry> backdrop(const Subject& subject = Subject());

/// Both.
osg::ref_ptr<osg::Geode> subjectGeode(const Subject& subject = Subject());

/// 16x16 texels of a smooth colored pattern, alpha falling from left to right.
osg::ref_ptr<osg::Image> pattern(GLenum pixelFormat, unsigned int seed = 0);

/// `pattern` without mipmaps, repeated.
osg::ref_ptr<osg::Texture2D> texture2D(GLenum pixelFormat = GL_RGB, unsigned int seed = 0);

/// A light of a color that depends on its number; directional, from the upper left.
osg::ref_ptr<osg::Light> light(unsigned int number = 0);

/// Adds a LightSource to the group and turns its light on there.
void addLight(osg::Group& root, osg::Light* light);

using Build = std::function<void(osg::Group& root)>;

/// Collects the scenes of one family.
class Family
{
public:
    Family(std::vector<FeatureScene>& scenes, const std::string& name)
        : _scenes(scenes), _name(name)
    {
    }

    /// A scene of the subject in a group that `build` gives its state.
    FeatureScene& add(const std::string& name, const Build& build,
                      const Subject& subject = Subject());

    /// A scene of what `build` adds to the group.
    FeatureScene& addNodes(const std::string& name, const Build& build);

private:
    std::vector<FeatureScene>& _scenes;
    std::string _name;
};

void addMaterialScenes(std::vector<FeatureScene>& scenes);
void addLightScenes(std::vector<FeatureScene>& scenes);
void addTextureScenes(std::vector<FeatureScene>& scenes);
void addTexEnvScenes(std::vector<FeatureScene>& scenes);
void addCombineScenes(std::vector<FeatureScene>& scenes);
void addTexGenScenes(std::vector<FeatureScene>& scenes);
void addFragmentScenes(std::vector<FeatureScene>& scenes);
void addVertexScenes(std::vector<FeatureScene>& scenes);
void addStateScenes(std::vector<FeatureScene>& scenes);
void addNodeScenes(std::vector<FeatureScene>& scenes);

} // namespace feature

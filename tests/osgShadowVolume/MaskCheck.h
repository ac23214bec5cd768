// SPDX-License-Identifier: MIT
#pragma once

#include "MaskComparison.h"

#include <osgShadowVolume/ShadowedScene.h>

#include <support/HeadlessViewer.h>

#include <osg/LightSource>

#include <map>
#include <string>
#include <vector>

namespace truth
{

/// How shadows are drawn; getName() is what tables call it.
struct Way
{
    osgShadowVolume::Shadows shadows = osgShadowVolume::Shadows::VOLUMES;
    osgShadowVolume::Technique technique = osgShadowVolume::Technique::AUTO;

    std::string getName() const;
};

/// Silhouette volumes by tessellation, geometry shader and CPU.
const std::vector<Way>& volumeWays();
/// Shadow maps.
Way mapWay();

/// The masks of one light in one view, by the names of the ways.
struct MaskResult
{
    int width = 0, height = 0;
    std::map<std::string, MaskDifference> differences;

    /// Of all ways but the maps.
    unsigned int getLeaks() const;
};

/// Draws masks with one ShadowedScene, whose programs last, and compares them with the truth.
class MaskCheck
{
public:
    /// Pictures start at this size and are enlarged up to four times.
    MaskCheck(int width, int height);

    support::HeadlessViewer& getViewer() { return _viewer; }
    osgShadowVolume::ShadowedScene& getKit() { return *_kit; }

    /// The mask of a light of the scene.
    osg::ref_ptr<osg::Image> render(osg::Node& scene, const support::CameraSpec& camera, int light,
                                    const Way& way, int width, int height);

    /// Compares each way's mask with the truth, in a picture so large that at most a quarter of the
    /// object's pixels lie in the band, or four times as large. A leak of a way other than the maps
    /// is a failure of the running test with pictures in build/images, if `isFailure`.
    MaskResult compare(osg::Node& scene, const support::CameraSpec& camera, int light,
                       const std::string& name, const std::vector<Way>& ways = volumeWays(),
                       bool isFailure = true);

private:
    void setUp(osg::Node& scene, int light, const Way& way);
    TruthPicture renderTruth(const ShadowTruth& truth, const Light& light) const;
    /// What the light adds to each pixel of the picture without any shadow, but for its ambient
    /// part, which shadows leave: the largest channel's share.
    std::vector<float> renderLight(osg::Node& scene, const support::CameraSpec& camera, int light,
                                   int width, int height);

    int _width, _height;
    support::HeadlessViewer _viewer;
    osg::ref_ptr<osgShadowVolume::ShadowedScene> _kit;
};

/// A LightSource whose position, and direction of a spot, are in the frame of its parents.
osg::ref_ptr<osg::LightSource> makeSource(int number, const osg::Vec4& position,
                                          const osg::Vec3& direction = osg::Vec3(0, 0, -1),
                                          float cutoffDegrees = 180.0f);

/// Rows of what was compared: one picture a row, each way's share of wrong pixels, and of those the
/// leaks.
class MaskTable
{
public:
    void add(const std::string& name, const MaskResult& result);
    /// To the terminal, with the sums.
    void print() const;

private:
    std::vector<std::pair<std::string, MaskResult>> _rows;
};

/// Whether the long run is asked for; see tests/run.sh.
bool isLongRun();

} // namespace truth

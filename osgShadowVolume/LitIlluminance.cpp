// SPDX-License-Identifier: MIT
// What LitPass does to measure light.
#include <osgShadowVolume/LitPass.h>

#include <cmath>
#include <limits>

namespace osgShadowVolume
{

namespace
{

/// Units of eye coordinates that a unit of the world has: view matrices may scale.
double viewScale(const osgMultiRender::SurfaceFrame& frame)
{
    auto& stage = const_cast<osgUtil::RenderStage&>(frame.getStage());
    const osg::RefMatrix* view = stage.getInitialViewMatrix();
    if (!view)
        return 1.0;
    const osg::Matrixd& m = *view;
    const osg::Vec3d rows[3] = {
        {m(0, 0), m(0, 1), m(0, 2)}, {m(1, 0), m(1, 1), m(1, 2)}, {m(2, 0), m(2, 1), m(2, 2)}};
    const double scale = std::cbrt(std::abs((rows[0] ^ rows[1]) * rows[2]));
    return scale > 0.0 && std::isfinite(scale) ? scale : 1.0;
}

} // namespace

bool LitPass::measure(EyeLight& eye, const osg::Light& light,
                      const osgMultiRender::SurfaceFrame& frame)
{
    const auto found = _measures.luxAtUnit.find(&light);
    if (found == _measures.luxAtUnit.end() && eye.isHeadlight)
    {
        _dropped.push_back({eye, "the headlight is no lamp of the scene"});
        return false;
    }
    eye.luxAtUnit = found == _measures.luxAtUnit.end() ? -1.0 : found->second;
    if (eye.luxAtUnit > 0.0 && !eye.isDirectional())
        eye.luxAtUnit *= std::pow(viewScale(frame), 2.0);
    if (eye.luxAtUnit == 0.0)
        _dropped.push_back({eye, "it gives off nothing"});
    return eye.luxAtUnit != 0.0;
}

double LitPass::reachOf(const EyeLight& light, double threshold) const
{
    // The inverse square law has no end.
    return measuresLight(_settings) ? std::numeric_limits<double>::infinity()
                                    : osgShadowVolume::reachOf(light, threshold);
}

} // namespace osgShadowVolume

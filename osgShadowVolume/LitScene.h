// SPDX-License-Identifier: MIT
#pragma once

#include <osgShadowVolume/Export.h>

#include <osgMultiRender/SurfaceGroup.h>

#include <memory>

namespace osgShadowVolume
{

/// A scene lit per pixel by any number of directional, point and spot lights.
///
/// Lights are the LightSources of the view, inside and outside of the group, and its headlight. A
/// light lights a drawable where its mode GL_LIGHT0 + number is on, as in OSG; numbers above 7 are
/// known too and kept from GL. Lights that reach nothing in view are dropped, and the plan says so.
/// The lighting equation is the fixed function's (OpenGL 2.1 specification, section 2.14.1), with
/// the interpolated normal made unit. A zero normal gets ambient light only; an attenuation with a
/// zero denominator saturates. Requires GL 3.3 compatibility; below that the model keeps its
/// fixed-function look.
class OSGSHADOWVOLUME_EXPORT LitScene : public osgMultiRender::SurfaceGroup
{
public:
    enum class Lighting
    {
        OFF,    ///< Surfaces show their unlit colours.
        VERTEX, ///< GL's lights 0 to 7 per vertex, the picture of the fixed function.
        PIXEL   ///< All lights per pixel.
    };
    enum class LightScope
    {
        MODES, ///< By GL_LIGHTn modes, as OSG means it. Of equal numbers the last one counts.
        ALL    ///< Every LightSource of the view lights the whole group.
    };

    LitScene();
    LitScene(const LitScene& other, const osg::CopyOp& copyop = osg::CopyOp::SHALLOW_COPY);
    META_Node(osgShadowVolume, LitScene)

    void setLighting(Lighting lighting) { _lighting = lighting; }
    Lighting getLighting() const { return _lighting; }

    void setLightScope(LightScope scope) { _lightScope = scope; }
    LightScope getLightScope() const { return _lightScope; }

    /// The most that all lights which are left out because of their distance may add to a channel
    /// of a pixel, 1 being full scale. By default 0.5 / 255, half a step of 8 bits; 0 leaves out
    /// nothing, more trades error for time where lights are many. Materials count as white. A bound
    /// up to 32 lights, an estimate at 64 points of the view for more.
    void setLightTolerance(double tolerance) { _lightTolerance = tolerance; }
    double getLightTolerance() const { return _lightTolerance; }

    void releaseGLObjects(osg::State* state = nullptr) const override;

protected:
    ~LitScene() override;

    std::unique_ptr<osgMultiRender::SurfacePass> createPass() const override;

private:
    Lighting _lighting = Lighting::PIXEL;
    LightScope _lightScope = LightScope::MODES;
    double _lightTolerance = 0.5 / 255.0;
    class LightTextures;
    std::unique_ptr<LightTextures> _textures;
    friend class LitPass;
};

} // namespace osgShadowVolume

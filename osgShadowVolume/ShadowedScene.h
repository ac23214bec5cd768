// SPDX-License-Identifier: MIT
#pragma once

#include <osgShadowVolume/LitScene.h>
#include <osgShadowVolume/ShadowSettings.h>

namespace osgShadowVolume
{

class IlluminanceView;
struct MirrorResources;
struct ShadowResources;

/// A LitScene whose lights cast hard shadows, right to the pixel, on everything in the group.
///
/// All triangles of the group cast, whatever the state of the mesh: open, non-manifold, wound in
/// any way. Points, lines, text and billboards cast nothing. What a light's ambient part adds is
/// not shadowed. Shadows need per-pixel lighting (setLighting(PIXEL), the default).
///
/// Setters may be called between frames; what they change is seen in the next one.
class OSGSHADOWVOLUME_EXPORT ShadowedScene : public LitScene
{
public:
    ShadowedScene();
    ShadowedScene(const ShadowedScene& other,
                  const osg::CopyOp& copyop = osg::CopyOp::SHALLOW_COPY);
    META_Node(osgShadowVolume, ShadowedScene)

    /// Under an event traversal also answers to keys; see ShadowKeys.h.
    void traverse(osg::NodeVisitor& visitor) override;

    void setSettings(const ShadowSettings& settings) { _settings = settings; }
    const ShadowSettings& getSettings() const { return _settings; }

    void setShadows(Shadows shadows) { _settings.shadows = shadows; }
    Shadows getShadows() const { return _settings.shadows; }

    void setTechnique(Technique technique) { _settings.technique = technique; }
    Technique getTechnique() const { return _settings.technique; }

    void setTransparentCasters(TransparentCasters which) { _settings.transparentCasters = which; }
    TransparentCasters getTransparentCasters() const { return _settings.transparentCasters; }

    /// Whether the viewer's headlight casts shadows. OSG's is directional, so in perspective its
    /// shadows show beside the objects; false by default.
    void setHeadlightShadow(bool on) { _settings.headlightShadow = on; }
    bool getHeadlightShadow() const { return _settings.headlightShadow; }

    /// Surfaces behind each other up to which each transparent one has its own shadows; what lies
    /// behind these takes those of the nearest one. 0 draws transparent surfaces without shadows.
    void setTransparentLayers(unsigned int layers) { _settings.transparentLayers = layers; }
    unsigned int getTransparentLayers() const { return _settings.transparentLayers; }

    /// Texels on a side of each shadow map, 16 to the driver's limit.
    void setMapSize(unsigned int texels) { _settings.mapSize = texels; }
    unsigned int getMapSize() const { return _settings.mapSize; }

    /// Percentage-closer filtering over a square of this many texels on a side; 1 is none.
    void setMapSamples(unsigned int side) { _settings.mapSamples = side; }
    unsigned int getMapSamples() const { return _settings.mapSamples; }

    /// Most memory of all shadow maps of a view; where it does not do, the maps are made smaller.
    void setMapMegabytes(unsigned int megabytes) { _settings.mapMegabytes = megabytes; }
    unsigned int getMapMegabytes() const { return _settings.mapMegabytes; }

    void setShow(Show show) { _settings.show = show; }
    Show getShow() const { return _settings.show; }

    /// The number of the one light that shines, or of whose mask is shown; -1 for all.
    void setLightShown(int number) { _settings.lightShown = number; }
    int getLightShown() const { return _settings.lightShown; }

    /// Whether flat surfaces that say they are mirrors reflect the group; MirrorNames.h says how
    /// they say it. One bounce, with all lights and shadows.
    void setMirrors(bool on) { _settings.mirrors = on; }
    bool getMirrors() const { return _settings.mirrors; }

    /// Planes that a view draws reflections for, the largest in the picture first. All mirrors of
    /// a plane are one.
    void setMaxMirrors(unsigned int planes) { _settings.maxMirrors = planes; }
    unsigned int getMaxMirrors() const { return _settings.maxMirrors; }

    /// Whether the group answers to keys of the viewer.
    void setKeys(bool on) { _settings.keys = on; }
    bool getKeys() const { return _settings.keys; }

    /// Metres that one unit of world coordinates stands for; 0 for unknown.
    void setMetresPerUnit(double metres) { _settings.metresPerUnit = metres; }
    double getMetresPerUnit() const { return _settings.metresPerUnit; }

    /// Lux at the top of the false colours; 0 for the largest value that the lights can give.
    void setIlluminanceMaximum(double lux) { _settings.illuminanceMaximum = lux; }
    double getIlluminanceMaximum() const { return _settings.illuminanceMaximum; }

    /// Candela of point and spot lights that state no intensity, for measuring; 0 for unknown.
    void setCandela(double candela) { _settings.candela = candela; }
    double getCandela() const { return _settings.candela; }

    /// Lux of directional lights that state none; 0 for unknown.
    void setLux(double lux) { _settings.lux = lux; }
    double getLux() const { return _settings.lux; }

    void resizeGLObjectBuffers(unsigned int maxSize) override;
    void releaseGLObjects(osg::State* state = nullptr) const override;

protected:
    ~ShadowedScene() override;

    std::unique_ptr<osgMultiRender::SurfacePass> createPass() const override;

private:
    ShadowSettings _settings;
    std::unique_ptr<ShadowResources> _resources;
    std::unique_ptr<MirrorResources> _mirrors;
    std::unique_ptr<IlluminanceView> _illuminance;
};

} // namespace osgShadowVolume

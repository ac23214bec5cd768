// SPDX-License-Identifier: MIT
#pragma once

#include <osgShadowVolume/LightReach.h>
#include <osgShadowVolume/LitScene.h>

#include <osg/StateSet>
#include <osg/Texture2D>

#include <map>
#include <mutex>

namespace osgShadowVolume
{

class LitPass;

/// Floats of a light in the layout of shaders/lights.frag: six vec4.
constexpr int FloatsPerLight = 24;
/// `shadow` is the light's index among those that cast visible shadows, -1 for none.
void packLight(const EyeLight& light, float shadow, float* to);

/// The light data of a LitScene on the GPU, one set a graphics context.
///
/// The layout is that of shaders/lights.frag. Textures exist only once something was set, and are
/// uploaded only when it changed.
class LitScene::LightTextures
{
public:
    static constexpr int LightsUnit = 14; ///< Texture unit of osgsv_lights.
    static constexpr int ListsUnit = 15;  ///< Texture unit of osgsv_lists.

    struct Context : public osg::Referenced
    {
        osg::ref_ptr<osg::Texture2D> lights;
        osg::ref_ptr<osg::Texture2D> lists;
        osg::ref_ptr<osg::StateSet> stateSet; ///< Binds both, over the model's own state.

        Context();
        /// Takes the light data of a pass. Draw thread of the context only.
        void set(const LitPass* pass, const std::vector<const EyeLight*>& eyeLights,
                 const std::vector<float>& shadows, const std::vector<std::int32_t>& list);
        /// Whether `pass` was the last to set its data.
        bool isOf(const LitPass* pass) const { return _pass == pass; }

    protected:
        ~Context() override = default;

    private:
        const LitPass* _pass = nullptr; ///< Only compared, never followed.
    };

    osg::ref_ptr<Context> get(unsigned int contextID);
    void releaseGLObjects(osg::State* state) const;

private:
    mutable std::mutex _mutex;
    std::map<unsigned int, osg::ref_ptr<Context>> _contexts;
};

} // namespace osgShadowVolume

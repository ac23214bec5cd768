// SPDX-License-Identifier: MIT
#pragma once

#include <osgShadowVolume/Export.h>

#include <osg/Camera>
#include <osg/Texture2D>

#include <glm/glm.hpp>

#include <mutex>
#include <vector>

namespace osgShadowVolume
{

/// What the pictures of mirrors look like.
struct MirrorLayout
{
    int width = 0, height = 0; ///< Pixels of the view.
    int samples = 0;

    bool operator==(const MirrorLayout& other) const
    {
        return width == other.width && height == other.height && samples == other.samples;
    }
};

/// Sees a group's subgraph as a mirror shows it, into a texture.
///
/// Its eye coordinates are those of the view with everything reflected, so that the picture has a
/// mirror's pixels where the view has the mirror. It is left and right exchanged: a reflection
/// turns triangles round, and so does the exchange, so that front faces stay front faces whatever
/// the model says of them.
class OSGSHADOWVOLUME_EXPORT MirrorCamera : public osg::Camera
{
public:
    explicit MirrorCamera(const MirrorLayout& layout);

    const MirrorLayout& getLayout() const { return _layout; }
    osg::Texture2D* getTexture() const { return _texture.get(); }

    /// Traverses what `group` does under a cull visitor that stands at the group. `plane` in eye
    /// coordinates is positive on the viewer's side; `tolerance` is how far off it the mirror may
    /// lie.
    void cull(osgUtil::CullVisitor& visitor, osg::Group& group, const glm::dvec4& plane,
              double tolerance);

    // For the frame of the group that cull() traverses.
    const glm::dvec4& getPlane() const { return _plane; }
    double getTolerance() const { return _tolerance; }

    /// Whether the visitor is inside of one, and of which it draws the picture.
    static bool isInside(const osg::NodeVisitor& visitor);

    void traverse(osg::NodeVisitor& visitor) override;

protected:
    ~MirrorCamera() override = default;

private:
    const MirrorLayout _layout;
    osg::ref_ptr<osg::Texture2D> _texture;
    glm::dvec4 _plane{0.0};
    double _tolerance = 0.0;
    osg::Group* _group = nullptr; ///< During cull().
};

/// The cameras of a ShadowedScene that no frame uses just now. Each graphics context has its own:
/// frames of different viewers are counted apart. Thread safe.
class OSGSHADOWVOLUME_EXPORT MirrorPool
{
public:
    osg::ref_ptr<MirrorCamera> acquire(unsigned int contextID, const MirrorLayout& layout);
    void release(unsigned int contextID, osg::ref_ptr<MirrorCamera> camera,
                 unsigned int frameNumber);
    /// Drops those of the context that have not been used for some frames, and their textures.
    void evict(unsigned int contextID, unsigned int frameNumber);
    void releaseGLObjects(osg::State* state);

private:
    struct Free
    {
        unsigned int contextID = 0;
        osg::ref_ptr<MirrorCamera> camera;
        unsigned int frameNumber = 0;
    };
    std::mutex _mutex;
    std::vector<Free> _free;
};

} // namespace osgShadowVolume

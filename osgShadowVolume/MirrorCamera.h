// SPDX-License-Identifier: MIT
#pragma once

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
class MirrorCamera : public osg::Camera
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

/// The cameras of a ShadowedScene that no frame uses just now. Thread safe.
class MirrorPool
{
public:
    osg::ref_ptr<MirrorCamera> acquire(const MirrorLayout& layout);
    void release(osg::ref_ptr<MirrorCamera> camera, unsigned int frameNumber);
    /// Drops those that have not been used for some frames, and their textures with them.
    void evict(unsigned int frameNumber);
    void releaseGLObjects(osg::State* state) const;

private:
    struct Free
    {
        osg::ref_ptr<MirrorCamera> camera;
        unsigned int frameNumber = 0;
    };
    mutable std::mutex _mutex;
    std::vector<Free> _free;
};

} // namespace osgShadowVolume

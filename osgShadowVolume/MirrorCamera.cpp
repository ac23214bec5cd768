// SPDX-License-Identifier: MIT
#include <osgShadowVolume/MirrorCamera.h>

#include <osgShadowVolume/MirrorShape.h>

#include <osg/ClipPlane>
#include <osgUtil/CullVisitor>

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>

namespace osgShadowVolume
{

namespace
{

/// The last one that every OpenGL has; scenes begin to count at 0.
constexpr unsigned int ClipPlaneNumber = 5;
constexpr unsigned int FramesKept = 3; ///< More than threads keep in flight.

} // namespace

MirrorCamera::MirrorCamera(const MirrorLayout& layout)
    : _layout(layout), _texture(new osg::Texture2D)
{
    setThreadSafeRefUnref(true);
    _texture->setTextureSize(layout.width, layout.height);
    _texture->setInternalFormat(GL_RGBA8);
    _texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::NEAREST);
    _texture->setFilter(osg::Texture::MAG_FILTER, osg::Texture::NEAREST);
    _texture->setResizeNonPowerOfTwoHint(false);
    const auto samples = static_cast<unsigned int>(layout.samples);
    attach(COLOR_BUFFER0, _texture.get(), 0, 0, false, samples, samples);
    attach(PACKED_DEPTH_STENCIL_BUFFER, GL_DEPTH24_STENCIL8_EXT);
    setRenderTargetImplementation(FRAME_BUFFER_OBJECT);
    setRenderOrder(PRE_RENDER);
    setReferenceFrame(osg::Transform::RELATIVE_RF);
    setTransformOrder(POST_MULTIPLY);
    setProjectionMatrix(osg::Matrixd::scale(-1.0, 1.0, 1.0));
    setViewport(0, 0, layout.width, layout.height);
    // The view's colour is what is seen where nothing is reflected, but all is cleared.
    setClearMask(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
    getOrCreateStateSet()->setMode(GL_CLIP_PLANE0 + ClipPlaneNumber,
                                   osg::StateAttribute::ON | osg::StateAttribute::OVERRIDE |
                                       osg::StateAttribute::PROTECTED);
}

void MirrorCamera::cull(osgUtil::CullVisitor& visitor, osg::Group& group, const glm::dvec4& plane,
                        double tolerance)
{
    setViewMatrix(osg::Matrixd(glm::value_ptr(reflectionIn(plane))));
    _plane = plane;
    _tolerance = tolerance;
    _group = &group;
    accept(visitor);
    _group = nullptr;
}

void MirrorCamera::traverse(osg::NodeVisitor& visitor)
{
    osgUtil::CullVisitor* culling = visitor.asCullVisitor();
    if (!culling || !_group)
        return;
    // What a mirror shows lies behind it: nothing that is there itself is seen.
    osg::ref_ptr<osg::ClipPlane> clip = new osg::ClipPlane(ClipPlaneNumber);
    clip->setClipPlane(-_plane.x, -_plane.y, -_plane.z, -_plane.w);
    culling->addPositionedAttribute(nullptr, clip.get());
    _group->traverse(visitor);
}

bool MirrorCamera::isInside(const osg::NodeVisitor& visitor)
{
    const osg::NodePath& path = visitor.getNodePath();
    return std::any_of(path.begin(), path.end(),
                       [](const osg::Node* node)
                       { return dynamic_cast<const MirrorCamera*>(node) != nullptr; });
}

osg::ref_ptr<MirrorCamera> MirrorPool::acquire(const MirrorLayout& layout)
{
    std::lock_guard<std::mutex> lock(_mutex);
    const auto found =
        std::find_if(_free.begin(), _free.end(),
                     [&](const Free& free) { return free.camera->getLayout() == layout; });
    if (found == _free.end())
        return new MirrorCamera(layout);
    osg::ref_ptr<MirrorCamera> camera = found->camera;
    _free.erase(found);
    return camera;
}

void MirrorPool::release(osg::ref_ptr<MirrorCamera> camera, unsigned int frameNumber)
{
    std::lock_guard<std::mutex> lock(_mutex);
    _free.push_back({std::move(camera), frameNumber});
}

void MirrorPool::evict(unsigned int frameNumber)
{
    std::lock_guard<std::mutex> lock(_mutex);
    _free.erase(std::remove_if(_free.begin(), _free.end(),
                               [&](const Free& free)
                               { return frameNumber - free.frameNumber > FramesKept; }),
                _free.end());
}

void MirrorPool::releaseGLObjects(osg::State* state) const
{
    std::lock_guard<std::mutex> lock(_mutex);
    for (const Free& free : _free)
        free.camera->releaseGLObjects(state);
}

} // namespace osgShadowVolume

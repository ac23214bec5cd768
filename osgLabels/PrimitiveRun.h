// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/PrimitiveShape.h>
#include <osgLabels/RecordPage.h>

#include <osg/Drawable>

#include <functional>
#include <vector>

namespace osgLabels
{

class PixelScale;
class PrimitiveMeshes;

/// Objects of one shape, and one MeshKind, in one cell of a PrimitiveBatch, drawn by instancing.
///
/// Visitors see the triangles of each object, one object after the other, all with the same number
/// of triangles: of the level VisitorLevel. Made by PrimitiveBatch; a default one is empty.
class OSGLABELS_EXPORT PrimitiveRun : public osg::Drawable
{
public:
    PrimitiveRun();
    /// `count` records of the page from `first` on, all of one kind, the farthest-reaching first;
    /// `firstObject` is the number of the first one in its batch.
    PrimitiveRun(RecordPage* page, unsigned int first, unsigned int count,
                 unsigned int firstObject);
    PrimitiveRun(const PrimitiveRun& other, const osg::CopyOp& copyop = osg::CopyOp::SHALLOW_COPY);

    META_Object(osgLabels, PrimitiveRun)

    Shape getShape() const { return _shape; }
    unsigned int getNumObjects() const { return _count; }
    /// The number of the first object in the batch; the others follow.
    unsigned int getFirstObject() const { return _firstObject; }
    /// Where its first record lies in its page.
    unsigned int getFirstRecord() const { return _first; }
    /// The object in the batch whose triangle has this index, as intersections say it.
    unsigned int getObject(unsigned int primitiveIndex) const;
    /// Triangles of each object, as visitors see them.
    unsigned int getNumTriangles() const;
    /// Of the i-th object of the run, in local coordinates.
    ObjectRecord getRecord(unsigned int i) const { return _page->getRecord(_first + i); }

    /// All objects in this level of detail, 0 to NumLevels - 1; -1 chooses by size on screen.
    void setLevel(int level) { _level = level; }
    int getLevel() const { return _level; }

    /// A part of a run that is drawn at once.
    struct Range
    {
        unsigned int first, count; ///< In the run.
        int level;
    };
    /// What is drawn in a view.
    void forEachRange(const PixelScale& scale, const std::function<void(const Range&)>& draw) const;

    /// Intersections by a line are found object by object, without the triangles of the others.
    void accept(osg::NodeVisitor& visitor) override;
    using osg::Drawable::accept;
    bool supports(const osg::PrimitiveFunctor&) const override { return true; }
    void accept(osg::PrimitiveFunctor& functor) const override;
    osg::BoundingBox computeBoundingBox() const override;
    void drawImplementation(osg::RenderInfo& renderInfo) const override;
    osg::VertexArrayState*
    createVertexArrayStateImplementation(osg::RenderInfo& renderInfo) const override;
    void compileGLObjects(osg::RenderInfo& renderInfo) const override;
    void resizeGLObjectBuffers(unsigned int maxSize) override;
    void releaseGLObjects(osg::State* state = nullptr) const override;

protected:
    ~PrimitiveRun() override;

private:
    void findCurves();
    void forEachNear(const PixelScale& scale, const std::function<void(const Range&)>& draw) const;
    void forEachFar(const PixelScale& scale, const std::function<void(const Range&)>& draw) const;

    /// From this object of the run on nothing is rounder than `radius`.
    struct Curve
    {
        unsigned int first;
        float radius;
    };

    osg::ref_ptr<RecordPage> _page;
    osg::ref_ptr<const PrimitiveMeshes> _meshes;
    std::vector<Curve> _curves;
    Shape _shape = Shape::None;
    unsigned int _first = 0, _count = 0, _firstObject = 0;
    int _level = -1;
};

} // namespace osgLabels

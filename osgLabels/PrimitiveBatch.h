// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/Export.h>
#include <osgLabels/NameList.h>
#include <osgLabels/PrimitiveRun.h>

#include <osg/Group>
#include <osg/Quat>
#include <osg/Vec3d>
#include <osg/Vec4ub>

#include <string>
#include <vector>

namespace osgLabels
{

/// One object of a PrimitiveBatch.
struct Primitive
{
    Shape shape = Shape::Box;              ///< One that isPrimitive() takes; an extrusion is a box.
    osg::Vec3 size{0.5f, 0.5f, 0.5f};      ///< See Shape; not negative.
    osg::Vec3d position;                   ///< Of the shape's frame, in the batch's coordinates.
    osg::Quat rotation;                    ///< From the shape's frame to the batch's coordinates.
    osg::Vec4ub color{255, 255, 255, 255}; ///< Alpha below 255 is transparent.
    std::string name;                      ///< UTF-8; line ends become spaces.
};

/// Millions of boxes, cylinders, spheres, dishes, frusta, pyramids, tori and quads, drawn by
/// instancing, each with a name of its own.
///
/// add() all objects, then build(). build() sorts them into cells of space and numbers them anew,
/// from 0. Each cell is a MatrixTransform, so that coordinates of any size keep their precision,
/// over one PrimitiveRun a shape. Detail is chosen by size on screen; what OSG's small-feature rule
/// says is too small is not drawn. Below a SurfaceGroup the objects look as with any other
/// drawable, elsewhere light 0 lights them.
///
/// An object takes 52 bytes on the GPU and 56 and its name on the CPU. Reading and changing objects
/// is for the thread of the update traversal. The children are the batch's own. Requires OpenGL
/// 3.3; without it, one warning and nothing drawn.
class OSGLABELS_EXPORT PrimitiveBatch : public osg::Group
{
public:
    PrimitiveBatch();
    PrimitiveBatch(const PrimitiveBatch& other,
                   const osg::CopyOp& copyop = osg::CopyOp::SHALLOW_COPY);

    META_Node(osgLabels, PrimitiveBatch)

    /// Adds an object, which is drawn after the next build(). False, with a warning, for one whose
    /// shape or numbers can't be drawn.
    bool add(const Primitive& primitive);
    /// Makes room for that many calls of add().
    void reserve(std::size_t objects, std::size_t nameBytes);
    /// Takes what was added since the last call in. Objects have other numbers afterwards.
    void build();
    void clear();

    /// How many build() has taken in.
    unsigned int getNumObjects() const { return _numObjects; }
    Primitive getPrimitive(unsigned int object) const;
    std::string getObjectName(unsigned int object) const { return std::string(_names[object]); }
    const NameList& getNames() const { return _names; }
    /// The object's record; its origin is relative to its cell's MatrixTransform.
    ObjectRecord getRecord(unsigned int object) const;

    /// What is shown from the next frame on. The alpha of an object stays what it was.
    void setColor(unsigned int object, const osg::Vec4ub& color);

    /// The object that an intersection, by drawable and primitive index, has hit; -1 for drawables
    /// that are no PrimitiveRun.
    static int objectOf(const osg::Drawable* drawable, unsigned int primitiveIndex);

    /// Objects a cell, at most RecordPage::MaxObjects; 0, as at first, for 1/256 of all, between
    /// 1024 and 8192. Counts at the next build().
    void setCellObjects(unsigned int objects) { _cellObjects = objects; }
    unsigned int getCellObjects() const { return _cellObjects; }
    /// All objects in this level of detail, see LevelSides; -1, as at first, chooses by size.
    void setLevel(int level);
    int getLevel() const { return _level; }

    /// All runs, in the order of their objects.
    const std::vector<osg::ref_ptr<PrimitiveRun>>& getRuns() const { return _runs; }
    std::size_t getNumCells() const { return _cells.size(); }
    /// Bytes for records, colours and names on the CPU.
    std::size_t getBytes() const;
    /// Bytes for records and colours on the GPU.
    std::size_t getGpuBytes() const;

    /// What build() makes and files hold.
    struct Cell
    {
        osg::Vec3d center;
        unsigned int firstObject = 0;
    };
    struct Run
    {
        unsigned int cell = 0, count = 0;
        bool transparent = false;
    };
    struct Content
    {
        std::vector<osg::ref_ptr<RecordPage>> pages; ///< A cell lies in one page.
        std::vector<Cell> cells;                     ///< In the order of their objects.
        std::vector<Run> runs;                       ///< In the order of their objects.
        NameList names;
    };
    Content getContent() const;
    /// Takes what getContent() gave. Returns what is wrong with it, the batch then being empty, or
    /// an empty text.
    std::string setContent(Content content);

protected:
    ~PrimitiveBatch() override = default;

private:
    friend class CellBuilder;

    /// Before build(): the record's origin is not set.
    struct Added
    {
        osg::Vec3d position;
        ObjectRecord record;
        osg::Vec4ub color;
    };

    std::pair<RecordPage*, unsigned int> find(unsigned int object) const;
    const Cell& cellOf(unsigned int object) const;
    void takeApart();
    std::string check(const Content& content) const;
    void makeNodes();

    std::vector<Added> _added;
    NameList _addedNames;
    std::vector<osg::ref_ptr<RecordPage>> _pages;
    std::vector<unsigned int> _pageStarts; ///< Number of each page's first object.
    std::vector<Cell> _cells;
    std::vector<Run> _runData;
    std::vector<osg::ref_ptr<PrimitiveRun>> _runs;
    NameList _names;
    unsigned int _numObjects = 0, _cellObjects = 0;
    int _level = -1;
};

} // namespace osgLabels

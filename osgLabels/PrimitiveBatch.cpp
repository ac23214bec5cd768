// SPDX-License-Identifier: MIT
#include <osgLabels/PrimitiveBatch.h>

#include "CellBuilder.h"

#include <osgLabels/UnitMesh.h>

#include <osg/MatrixTransform>
#include <osg/Notify>

#include <algorithm>
#include <cmath>

namespace osgLabels
{

namespace
{

/// Why an object can't be drawn; empty if it can.
std::string faultOf(const Primitive& primitive)
{
    if (!isPrimitive(primitive.shape))
        return "shape " + std::to_string(unsigned(primitive.shape)) + " has no mesh";
    for (int axis = 0; axis < 3; ++axis)
        if (!(primitive.size[axis] >= 0.0f) || std::isinf(primitive.size[axis]))
            return "its size is negative or not finite";
    const osg::Vec3d& at = primitive.position;
    if (!std::isfinite(at.x()) || !std::isfinite(at.y()) || !std::isfinite(at.z()))
        return "its position is not finite";
    if (!(primitive.rotation.length2() > 0.0) || std::isinf(primitive.rotation.length2()))
        return "its rotation is no quaternion";
    return {};
}

/// A group over each eight neighbours, level by level, so that culling need not look at each cell.
osg::ref_ptr<osg::Group> gather(const std::vector<osg::ref_ptr<osg::Group>>& cells)
{
    std::vector<osg::ref_ptr<osg::Group>> level = cells;
    while (level.size() > 8)
    {
        std::vector<osg::ref_ptr<osg::Group>> above;
        for (std::size_t i = 0; i < level.size(); ++i)
        {
            if (i % 8 == 0)
                above.push_back(new osg::Group);
            above.back()->addChild(level[i]);
        }
        level = std::move(above);
    }
    osg::ref_ptr<osg::Group> top = new osg::Group;
    for (const osg::ref_ptr<osg::Group>& group : level)
        top->addChild(group);
    return top;
}

} // namespace

PrimitiveBatch::PrimitiveBatch() = default;

PrimitiveBatch::PrimitiveBatch(const PrimitiveBatch& other, const osg::CopyOp& copyop)
    : osg::Group(other, copyop), _added(other._added), _addedNames(other._addedNames),
      _cellObjects(other._cellObjects), _level(other._level)
{
    Content content = other.getContent();
    if (copyop.getCopyFlags() & osg::CopyOp::DEEP_COPY_ARRAYS)
        for (osg::ref_ptr<RecordPage>& page : content.pages)
            page = new RecordPage(new osg::UIntArray(page->getRecords()),
                                  new osg::Vec4ubArray(page->getColors()));
    setContent(std::move(content));
}

bool PrimitiveBatch::add(const Primitive& primitive)
{
    const std::string fault = faultOf(primitive);
    if (!fault.empty())
    {
        OSG_WARN << "osgLabels::PrimitiveBatch: '" << primitive.name << "' is left out, " << fault
                 << std::endl;
        return false;
    }
    const osg::Quat inverse = primitive.rotation.inverse();
    const double length = std::sqrt(inverse.length2());
    Added added;
    added.position = primitive.position;
    added.color = primitive.color;
    added.record.rotation = glm::quat(float(inverse.w() / length), float(inverse.x() / length),
                                      float(inverse.y() / length), float(inverse.z() / length));
    added.record.shape = std::uint32_t(primitive.shape);
    added.record.size = glm::vec3(primitive.size.x(), primitive.size.y(), primitive.size.z());
    _added.push_back(added);
    std::string name = primitive.name;
    std::replace(name.begin(), name.end(), '\n', ' ');
    std::replace(name.begin(), name.end(), '\r', ' ');
    return _addedNames.add(name);
}

void PrimitiveBatch::reserve(std::size_t objects, std::size_t nameBytes)
{
    _added.reserve(_added.size() + objects);
    _addedNames.reserve(_addedNames.size() + objects, _addedNames.block().size() + nameBytes);
}

/// All objects become added ones again.
void PrimitiveBatch::takeApart()
{
    std::vector<Added> added;
    NameList names;
    added.reserve(_numObjects + _added.size());
    names.reserve(_numObjects + _added.size(), _names.block().size() + _addedNames.block().size());
    for (unsigned int i = 0; i < _numObjects; ++i)
    {
        const auto [page, inPage] = find(i);
        const ObjectRecord record = page->getRecord(inPage);
        const osg::Vec3d origin(record.origin.x, record.origin.y, record.origin.z);
        added.push_back({cellOf(i).center + origin, record, page->getColor(inPage)});
        names.add(_names[i]);
    }
    added.insert(added.end(), _added.begin(), _added.end());
    for (std::size_t i = 0; i < _addedNames.size(); ++i)
        names.add(_addedNames[i]);
    _added = std::move(added);
    _addedNames = std::move(names);
}

void PrimitiveBatch::build()
{
    if (_numObjects)
        takeApart();
    const std::size_t share = _added.size() / 256;
    const std::size_t objects =
        _cellObjects ? _cellObjects : std::clamp<std::size_t>(share, 1024, 8192);
    Content content = CellBuilder(_added, _addedNames,
                                  unsigned(std::min<std::size_t>(objects, RecordPage::MaxObjects)))
                          .build();
    _added = {};
    _addedNames = {};
    setContent(std::move(content));
}

void PrimitiveBatch::clear()
{
    _added = {};
    _addedNames = {};
    setContent({});
}

std::pair<RecordPage*, unsigned int> PrimitiveBatch::find(unsigned int object) const
{
    const auto next = std::upper_bound(_pageStarts.begin(), _pageStarts.end(), object);
    const std::size_t page = std::size_t(next - _pageStarts.begin()) - 1;
    return {_pages[page].get(), object - _pageStarts[page]};
}

const PrimitiveBatch::Cell& PrimitiveBatch::cellOf(unsigned int object) const
{
    const auto next =
        std::upper_bound(_cells.begin(), _cells.end(), object,
                         [](unsigned int o, const Cell& cell) { return o < cell.firstObject; });
    return next[-1];
}

ObjectRecord PrimitiveBatch::getRecord(unsigned int object) const
{
    const auto [page, inPage] = find(object);
    return page->getRecord(inPage);
}

Primitive PrimitiveBatch::getPrimitive(unsigned int object) const
{
    const auto [page, inPage] = find(object);
    const ObjectRecord record = page->getRecord(inPage);
    Primitive primitive;
    primitive.shape = shapeOf(record);
    primitive.size.set(record.size.x, record.size.y, record.size.z);
    primitive.position =
        cellOf(object).center + osg::Vec3d(record.origin.x, record.origin.y, record.origin.z);
    primitive.rotation.set(-record.rotation.x, -record.rotation.y, -record.rotation.z,
                           record.rotation.w);
    primitive.color = page->getColor(inPage);
    primitive.name = getObjectName(object);
    return primitive;
}

void PrimitiveBatch::setColor(unsigned int object, const osg::Vec4ub& color)
{
    const auto [page, inPage] = find(object);
    osg::Vec4ub kept = color;
    kept.a() = page->getColor(inPage).a();
    page->setColor(inPage, kept);
}

int PrimitiveBatch::objectOf(const osg::Drawable* drawable, unsigned int primitiveIndex)
{
    const auto* run = dynamic_cast<const PrimitiveRun*>(drawable);
    return run && run->getNumObjects() ? int(run->getObject(primitiveIndex)) : -1;
}

void PrimitiveBatch::setLevel(int level)
{
    _level = std::clamp(level, -1, NumLevels - 1);
    for (const osg::ref_ptr<PrimitiveRun>& run : _runs)
        run->setLevel(_level);
}

std::size_t PrimitiveBatch::getBytes() const
{
    return getGpuBytes() + _names.bytes();
}

std::size_t PrimitiveBatch::getGpuBytes() const
{
    return std::size_t(_numObjects) * (sizeof(ObjectRecord) + sizeof(osg::Vec4ub));
}

PrimitiveBatch::Content PrimitiveBatch::getContent() const
{
    return {_pages, _cells, _runData, _names};
}

std::string PrimitiveBatch::check(const Content& content) const
{
    std::size_t objects = 0, inRuns = 0;
    std::vector<std::size_t> starts;
    for (const osg::ref_ptr<RecordPage>& page : content.pages)
    {
        if (!page || page->getRecords().size() != ObjectRecord::Words * page->size() ||
            page->size() == 0 || page->size() > RecordPage::MaxObjects)
            return "a page of a wrong size";
        starts.push_back(objects);
        objects += page->size();
    }
    if (content.names.size() != objects)
        return std::to_string(content.names.size()) + " names for " + std::to_string(objects) +
               " objects";
    unsigned int cell = 0;
    for (std::size_t i = 0; i < content.runs.size(); ++i)
    {
        const Run& run = content.runs[i];
        const bool next = i > 0 && run.cell == cell + 1;
        if (run.cell >= content.cells.size() || run.count == 0 || run.count > objects - inRuns ||
            (i == 0 ? run.cell != 0 : run.cell != cell && !next) ||
            ((i == 0 || next) && content.cells[run.cell].firstObject != inRuns))
            return "runs that don't fit the cells";
        const auto page = std::upper_bound(starts.begin(), starts.end(), inRuns) - 1;
        RecordPage& records = *content.pages[std::size_t(page - starts.begin())];
        if (inRuns - *page + run.count > records.size())
            return "a run over two pages";
        const ObjectRecord first = records.getRecord(unsigned(inRuns - *page));
        for (unsigned int o = 0; o < run.count; ++o)
        {
            const ObjectRecord record = records.getRecord(unsigned(inRuns - *page) + o);
            if (!isPrimitive(shapeOf(record)) || kindOf(record).number() != kindOf(first).number())
                return "a shape that can't be drawn";
        }
        cell = run.cell;
        inRuns += run.count;
    }
    if (inRuns != objects || (objects && cell + 1 != content.cells.size()))
        return "runs for " + std::to_string(inRuns) + " of " + std::to_string(objects) + " objects";
    return {};
}

std::string PrimitiveBatch::setContent(Content content)
{
    const std::string fault = check(content);
    if (!fault.empty())
        content = {};
    _pages = std::move(content.pages);
    _cells = std::move(content.cells);
    _runData = std::move(content.runs);
    _names = std::move(content.names);
    _pageStarts.clear();
    _numObjects = 0;
    for (const osg::ref_ptr<RecordPage>& page : _pages)
    {
        _pageStarts.push_back(_numObjects);
        _numObjects += page->size();
    }
    makeNodes();
    return fault;
}

void PrimitiveBatch::makeNodes()
{
    removeChildren(0, getNumChildren());
    _runs.clear();
    std::vector<osg::ref_ptr<osg::Group>> cells;
    unsigned int object = 0;
    for (const Run& run : _runData)
    {
        if (run.cell == cells.size())
        {
            osg::ref_ptr<osg::MatrixTransform> transform =
                new osg::MatrixTransform(osg::Matrix::translate(_cells[run.cell].center));
            // Or the viewer's optimizer would try to move it into the records.
            transform->setDataVariance(osg::Object::DYNAMIC);
            cells.push_back(transform);
        }
        const auto [page, inPage] = find(object);
        osg::ref_ptr<PrimitiveRun> drawable = new PrimitiveRun(page, inPage, run.count, object);
        drawable->setLevel(_level);
        drawable->setStateSet(page->getStateSet(run.transparent));
        cells.back()->addChild(drawable);
        _runs.push_back(drawable);
        object += run.count;
    }
    if (!cells.empty())
        addChild(gather(cells));
}

} // namespace osgLabels

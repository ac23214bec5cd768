// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/Export.h>
#include <osgLabels/ObjectRecord.h>

#include <osg/Array>
#include <osg/StateSet>

namespace osgLabels
{

/// Object records and colours as they lie on the GPU: two texture buffers of at most 65536 texels,
/// which is what any OpenGL 3.3 takes. The same memory is what the CPU knows of the objects.
class OSGLABELS_EXPORT RecordPage : public osg::Referenced
{
public:
    static constexpr unsigned int MaxObjects = 65536 / 3;

    /// Of `objects` objects, not more than MaxObjects, which are to be set.
    explicit RecordPage(unsigned int objects);
    /// Takes the arrays; `records` has 12 words a colour.
    RecordPage(osg::UIntArray* records, osg::Vec4ubArray* colors);

    unsigned int size() const { return static_cast<unsigned int>(_colors->size()); }

    ObjectRecord getRecord(unsigned int i) const;
    /// Only before anything else has the page.
    void setRecord(unsigned int i, const ObjectRecord& record);
    const osg::Vec4ub& getColor(unsigned int i) const { return (*_colors)[i]; }
    void setColor(unsigned int i, const osg::Vec4ub& color);

    const osg::UIntArray& getRecords() const { return *_records; }
    const osg::Vec4ubArray& getColors() const { return *_colors; }

    /// What drawables of this page need: the buffers, a program, a material that takes colours.
    osg::StateSet* getStateSet(bool transparent) const { return _stateSets[transparent].get(); }

    /// The buffers' part of what nodes do; the state sets are the nodes' own to forward.
    void resizeGLObjectBuffers(unsigned int maxSize);
    void releaseGLObjects(osg::State* state) const;

protected:
    ~RecordPage() override = default;

private:
    void makeStateSets();

    osg::ref_ptr<osg::UIntArray> _records;
    osg::ref_ptr<osg::Vec4ubArray> _colors;
    osg::ref_ptr<osg::StateSet> _stateSets[2];
};

} // namespace osgLabels

// SPDX-License-Identifier: MIT
#include <osgLabels/PrimitiveBatch.h>

#include <osgDB/InputStream>
#include <osgDB/ObjectWrapper>
#include <osgDB/OutputStream>
#include <osgDB/Serializer>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <limits>

namespace
{

using osgLabels::PrimitiveBatch;
using osgLabels::RecordPage;

// Binary files hold the arrays as they lie in memory, text files one object after the other.

constexpr std::size_t PieceBytes = 1 << 20;

/// In pieces with a length each, so that a wrong count in a file ends at the end of the file and
/// not in the allocator.
template <class Word> void writeWords(osgDB::OutputStream& os, const Word* words, std::size_t count)
{
    while (count)
    {
        const std::size_t size = std::min(PieceBytes / sizeof(Word), count);
        os << static_cast<unsigned int>(size);
        os.writeCharArray(reinterpret_cast<const char*>(words),
                          static_cast<unsigned int>(sizeof(Word) * size));
        words += size;
        count -= size;
    }
}

template <class Word>
bool readWords(osgDB::InputStream& is, std::vector<Word>& words, std::size_t count)
{
    while (words.size() < count)
    {
        unsigned int size = 0;
        is >> size;
        if (is.getException() || size == 0 || size > PieceBytes / sizeof(Word) ||
            size > count - words.size())
            return false;
        const std::size_t first = words.size();
        words.resize(first + size);
        is.readComponentArray(reinterpret_cast<char*>(&words[first]), size, 1, sizeof(Word));
    }
    return true;
}

void fail(osgDB::InputStream& is, PrimitiveBatch& batch, const std::string& cause)
{
    batch.clear();
    is.throwException("osgLabels::PrimitiveBatch: " + cause);
}

void writeBinary(osgDB::OutputStream& os, const PrimitiveBatch& batch)
{
    const PrimitiveBatch::Content content = batch.getContent();
    os << static_cast<unsigned int>(content.pages.size());
    for (const osg::ref_ptr<RecordPage>& page : content.pages)
    {
        os << page->size();
        writeWords(os, &page->getRecords().front(), page->getRecords().size());
        writeWords(os, page->getColors().front().ptr(), 4 * page->size());
    }
    os << static_cast<unsigned int>(content.cells.size());
    for (const PrimitiveBatch::Cell& cell : content.cells)
        os << cell.center << cell.firstObject;
    os << static_cast<unsigned int>(content.runs.size());
    for (const PrimitiveBatch::Run& run : content.runs)
        os << run.cell << run.count << run.transparent;
    const osgLabels::NameList& names = content.names;
    os << static_cast<unsigned int>(names.block().size());
    writeWords(os, names.block().data(), names.block().size());
    writeWords(os, names.ends().data(), names.ends().size());
}

osg::ref_ptr<RecordPage> readPage(osgDB::InputStream& is)
{
    unsigned int size = 0;
    is >> size;
    if (size == 0 || size > RecordPage::MaxObjects)
        return nullptr;
    osg::ref_ptr<osg::UIntArray> records = new osg::UIntArray;
    osg::ref_ptr<osg::Vec4ubArray> colors = new osg::Vec4ubArray(size);
    std::vector<unsigned char> channels;
    if (!readWords(is, records->asVector(), osgLabels::ObjectRecord::Words * size) ||
        !readWords(is, channels, 4 * std::size_t(size)))
        return nullptr;
    std::copy(channels.begin(), channels.end(), colors->front().ptr());
    return new RecordPage(records, colors);
}

std::string readContent(osgDB::InputStream& is, PrimitiveBatch::Content& content)
{
    unsigned int pages = 0, cells = 0, runs = 0, bytes = 0;
    std::size_t objects = 0;
    is >> pages;
    for (unsigned int i = 0; i < pages; ++i)
    {
        content.pages.push_back(readPage(is));
        if (!content.pages.back())
            return "a page of objects is cut off or has a wrong size";
        objects += content.pages.back()->size();
    }
    is >> cells;
    if (cells > objects)
        return "more cells than objects";
    content.cells.resize(cells);
    for (PrimitiveBatch::Cell& cell : content.cells)
        is >> cell.center >> cell.firstObject;
    is >> runs;
    if (runs > objects)
        return "more runs than objects";
    content.runs.resize(runs);
    for (PrimitiveBatch::Run& run : content.runs)
        is >> run.cell >> run.count >> run.transparent;
    is >> bytes;
    std::vector<char> block;
    std::vector<std::uint32_t> ends;
    if (!readWords(is, block, bytes) || !readWords(is, ends, objects))
        return "its names are cut off";
    if (!content.names.assign(std::string(block.begin(), block.end()), std::move(ends)))
        return "its names don't fit their lengths";
    return {};
}

// osgDB writes six digits, with which an object at 1e7 would move by metres. As words, numbers keep
// all that they have.
void writeNumbers(osgDB::OutputStream& os, const std::vector<double>& numbers, int digits)
{
    for (double number : numbers)
    {
        char text[40];
        std::snprintf(text, sizeof text, "%.*g", digits, number);
        os << std::string(text);
    }
}

double readNumber(osgDB::InputStream& is)
{
    std::string text;
    is >> text;
    char* end = nullptr;
    const double number = std::strtod(text.c_str(), &end);
    return text.empty() || *end ? std::numeric_limits<double>::quiet_NaN() : number;
}

void writeText(osgDB::OutputStream& os, const PrimitiveBatch& batch)
{
    for (unsigned int i = 0; i < batch.getNumObjects(); ++i)
    {
        const osgLabels::Primitive p = batch.getPrimitive(i);
        os << static_cast<unsigned int>(p.shape);
        writeNumbers(os, {p.size.x(), p.size.y(), p.size.z()}, 9);
        writeNumbers(os, {p.position.x(), p.position.y(), p.position.z()}, 17);
        writeNumbers(os, {p.rotation.x(), p.rotation.y(), p.rotation.z(), p.rotation.w()}, 9);
        for (int channel = 0; channel < 4; ++channel)
            os << static_cast<unsigned int>(p.color[channel]);
        os.writeWrappedString(p.name);
        os << std::endl;
    }
}

std::string readText(osgDB::InputStream& is, PrimitiveBatch& batch, unsigned int objects)
{
    for (unsigned int i = 0; i < objects; ++i)
    {
        osgLabels::Primitive primitive;
        unsigned int shape = 0;
        is >> shape;
        primitive.shape = osgLabels::Shape(shape);
        for (int axis = 0; axis < 3; ++axis)
            primitive.size[axis] = float(readNumber(is));
        for (int axis = 0; axis < 3; ++axis)
            primitive.position[axis] = readNumber(is);
        for (int axis = 0; axis < 4; ++axis)
            primitive.rotation[axis] = readNumber(is);
        for (int channel = 0; channel < 4; ++channel)
        {
            unsigned int value = 0;
            is >> value;
            primitive.color[channel] = static_cast<unsigned char>(std::min(value, 255u));
        }
        is.readWrappedString(primitive.name);
        if (is.getException())
            return "object " + std::to_string(i) + " is cut off";
        if (!batch.add(primitive))
            return "object " + std::to_string(i) + " can't be drawn";
    }
    batch.build();
    return {};
}

bool checkObjects(const PrimitiveBatch& batch)
{
    return batch.getNumObjects() > 0;
}

bool writeObjects(osgDB::OutputStream& os, const PrimitiveBatch& batch)
{
    os << batch.getNumObjects() << os.BEGIN_BRACKET << std::endl;
    if (os.isBinary())
        writeBinary(os, batch);
    else
        writeText(os, batch);
    os << os.END_BRACKET << std::endl;
    return true;
}

bool readObjects(osgDB::InputStream& is, PrimitiveBatch& batch)
{
    unsigned int objects = 0;
    is >> objects >> is.BEGIN_BRACKET;
    std::string fault;
    if (is.isBinary())
    {
        PrimitiveBatch::Content content;
        fault = readContent(is, content);
        if (fault.empty())
            fault = batch.setContent(std::move(content));
        if (fault.empty() && batch.getNumObjects() != objects)
            fault = "says " + std::to_string(objects) + " objects, has " +
                    std::to_string(batch.getNumObjects());
    }
    else
    {
        fault = readText(is, batch, objects);
    }
    if (!fault.empty())
    {
        fail(is, batch, fault);
        return false;
    }
    is >> is.END_BRACKET;
    return true;
}

} // namespace

// Not a Group in files: the children are made of the objects.
REGISTER_OBJECT_WRAPPER(osgLabels_PrimitiveBatch, new osgLabels::PrimitiveBatch,
                        osgLabels::PrimitiveBatch,
                        "osg::Object osg::Node osgLabels::PrimitiveBatch")
{
    ADD_UINT_SERIALIZER(CellObjects, 0);
    ADD_INT_SERIALIZER(Level, -1);
    ADD_USER_SERIALIZER(Objects);
}

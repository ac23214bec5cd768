// SPDX-License-Identifier: MIT
#include <osgPagedTexture/PackAppender.h>

namespace osgPagedTexture
{

namespace
{

constexpr std::size_t BufferBytes = 4 << 20;

} // namespace

void PackAppender::add(const void* bytes, std::uint64_t count)
{
    if (_buffer.size() + count > BufferBytes)
    {
        flush();
    }
    _buffer.append(static_cast<const char*>(bytes), count);
}

void PackAppender::flush()
{
    _file.write(_buffer.data(), _buffer.size(), _written);
    _written += _buffer.size();
    _buffer.clear();
}

PackAppender::Record PackAppender::append(RecordKind kind, std::uint64_t key, const void* bytes,
                                          std::uint64_t count)
{
    RecordHeader header;
    header.kind = kind;
    header.bytes = count;
    header.key = key;
    header.checksum = recordChecksum(header, bytes);
    const Record record{getPlace(), header.checksum};
    const std::uint64_t fill = 0;
    add(&header, sizeof(header));
    add(bytes, count);
    add(&fill, recordBytes(count) - sizeof(header) - count);
    return record;
}

void PackAppender::addPage(PackPage& page)
{
    page.checksum = pageChecksum(page, getPlace());
    add(&page, sizeof(page));
    page = PackPage();
}

PackSegment PackAppender::appendSegment(const NextEntry& next)
{
    RecordHeader header;
    header.kind = RecordKind::Index;
    const std::uint64_t headerPlace = getPlace();
    add(&header, sizeof(header)); // its place; what it says is known at the end
    PackSegment segment;
    segment.place = getPlace();
    PackPage page;
    for (auto entry = next(); entry; entry = next())
    {
        page.entries[page.count++] = *entry;
        ++segment.entries;
        if (page.count == PackPage::Capacity)
        {
            addPage(page);
        }
    }
    if (page.count > 0)
    {
        addPage(page);
    }
    flush();
    header.bytes = getPlace() - segment.place;
    header.checksum = recordChecksum(header, nullptr);
    segment.pages = header.bytes / sizeof(PackPage);
    _file.write(&header, sizeof(header), headerPlace);
    return segment;
}

} // namespace osgPagedTexture

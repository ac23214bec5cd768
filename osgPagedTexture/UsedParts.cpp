// SPDX-License-Identifier: MIT
#include <osgPagedTexture/UsedParts.h>

#include <algorithm>
#include <map>
#include <utility>

namespace osgPagedTexture
{

namespace
{

/// The mask in blocks, the top row first: which hold a used pixel.
struct Blocks
{
    int columns = 0, rows = 0;
    std::vector<std::uint8_t> used;

    Blocks(const Pixels& mask, int block)
        : columns((mask.width + block - 1) / block), rows((mask.height + block - 1) / block),
          used(std::size_t(columns) * std::size_t(rows))
    {
        for (int y = 0; y < mask.height; ++y)
        {
            const std::uint8_t* row = mask.row(mask.height - 1 - y);
            std::uint8_t* to = used.data() + std::size_t(y / block) * std::size_t(columns);
            for (int x = 0; x < mask.width; ++x)
                to[x / block] |= row[x];
        }
    }
    std::uint8_t& at(int x, int y)
    {
        return used[std::size_t(y) * std::size_t(columns) + std::size_t(x)];
    }
};

struct Box
{
    int left, top, right, bottom; ///< Blocks, all included.

    bool overlaps(const Box& other) const
    {
        return left <= other.right && other.left <= right && top <= other.bottom &&
               other.top <= bottom;
    }
    void include(const Box& other)
    {
        left = std::min(left, other.left);
        top = std::min(top, other.top);
        right = std::max(right, other.right);
        bottom = std::max(bottom, other.bottom);
    }
};

/// The box of all used blocks that are connected with one, which are then no longer used.
Box takeConnected(Blocks& blocks, int x, int y)
{
    Box box{x, y, x, y};
    std::vector<std::pair<int, int>> open{{x, y}};
    blocks.at(x, y) = 0;
    while (!open.empty())
    {
        const auto [column, row] = open.back();
        open.pop_back();
        box.include({column, row, column, row});
        for (int nextY = std::max(row - 1, 0); nextY <= std::min(row + 1, blocks.rows - 1); ++nextY)
        {
            for (int nextX = std::max(column - 1, 0);
                 nextX <= std::min(column + 1, blocks.columns - 1); ++nextX)
            {
                if (blocks.at(nextX, nextY) == 0)
                    continue;
                blocks.at(nextX, nextY) = 0;
                open.emplace_back(nextX, nextY);
            }
        }
    }
    return box;
}

/// Adds a box, taking in all that it overlaps, until nothing does.
void addBox(std::vector<Box>& boxes, Box box)
{
    for (std::size_t i = 0; i < boxes.size();)
    {
        if (!box.overlaps(boxes[i]))
        {
            ++i;
            continue;
        }
        box.include(boxes[i]);
        boxes[i] = boxes.back();
        boxes.pop_back();
        i = 0;
    }
    boxes.push_back(box);
}

std::vector<PixelRect> partsOf(const std::vector<Box>& boxes, const Pixels& mask, int block)
{
    std::vector<PixelRect> parts;
    for (const Box& box : boxes)
    {
        const int left = box.left * block, top = box.top * block;
        parts.push_back({left, top, std::min((box.right + 1) * block, mask.width) - left,
                         std::min((box.bottom + 1) * block, mask.height) - top});
    }
    return parts;
}

} // namespace

std::vector<PixelRect> findUsedParts(const Pixels& mask, int block)
{
    Blocks blocks(mask, block);
    std::vector<Box> boxes;
    for (int y = 0; y < blocks.rows; ++y)
        for (int x = 0; x < blocks.columns; ++x)
            if (blocks.at(x, y) != 0)
                addBox(boxes, takeConnected(blocks, x, y));
    std::sort(boxes.begin(), boxes.end(),
              [](const Box& a, const Box& b)
              { return std::pair(a.top, a.left) < std::pair(b.top, b.left); });
    return partsOf(boxes, mask, block);
}

std::vector<PixelRect> findUsedBlocks(const Pixels& mask, int block)
{
    Blocks blocks(mask, block);
    std::vector<Box> boxes;
    std::map<std::pair<int, int>, std::size_t> above; // boxes that end in the row above, by sides
    for (int y = 0; y < blocks.rows; ++y)
    {
        std::map<std::pair<int, int>, std::size_t> here;
        for (int x = 0; x < blocks.columns; ++x)
        {
            const int left = x;
            while (x < blocks.columns && blocks.at(x, y) != 0)
                ++x;
            if (x == left)
                continue;
            const auto found = above.find({left, x - 1});
            const std::size_t number = found == above.end() ? boxes.size() : found->second;
            if (found == above.end())
                boxes.push_back({left, y, x - 1, y});
            boxes[number].bottom = y;
            here[{left, x - 1}] = number;
        }
        above = std::move(here);
    }
    return partsOf(boxes, mask, block);
}

} // namespace osgPagedTexture

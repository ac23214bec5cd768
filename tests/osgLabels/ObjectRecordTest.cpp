// SPDX-License-Identifier: MIT
#include <osgLabels/ObjectRecord.h>

#include <gtest/gtest.h>

namespace
{

float floatOf(std::uint32_t word)
{
    float value;
    std::memcpy(&value, &word, sizeof value);
    return value;
}

} // namespace

TEST(ObjectRecordTest, theWordsLieAsTheShaderReadsThem)
{
    osgLabels::ObjectRecord record;
    record.rotation = glm::quat(0.5f, -0.5f, 0.25f, 0.125f); // w, x, y, z
    record.origin = glm::vec3(1.0f, 2.0f, 3.0f);
    record.shape = std::uint32_t(osgLabels::Shape::Torus) | osgLabels::Projected;
    record.size = glm::vec3(4.0f, 5.0f, 6.0f);
    record.identifier = 0x7fffffffu;
    const auto words = record.pack();
    const float floats[] = {-0.5f, 0.25f, 0.125f, 0.5f, 1.0f, 2.0f, 3.0f};
    for (int i = 0; i < 7; ++i)
        EXPECT_EQ(floatOf(words[i]), floats[i]) << i;
    EXPECT_EQ(words[7], 0x107u);
    for (int i = 0; i < 3; ++i)
        EXPECT_EQ(floatOf(words[8 + i]), 4.0f + i) << i;
    EXPECT_EQ(words[11], 0x7fffffffu);
}

// SPDX-License-Identifier: MIT
#include "CityNames.h"

#include <iterator>

namespace
{

constexpr const char* Streets[2][16] = {
    {"Main Street", "Mill Lane", "Church Street", "Bridge Street", "Orchard Row", "Harbour Street",
     "Foundry Lane", "School Street", "Garden Row", "Castle Street", "Meadow Lane", "Baker Street",
     "Station Street", "Quarry Lane", "Chapel Row", "Brewery Street"},
    {"Linden Avenue", "Oak Avenue", "Park Avenue", "Maple Avenue", "Birch Avenue", "Elm Avenue",
     "Cedar Avenue", "Chestnut Avenue", "Ash Avenue", "Willow Avenue", "Poplar Avenue",
     "Hazel Avenue", "Rowan Avenue", "Cherry Avenue", "Walnut Avenue", "Beech Avenue"}};

constexpr const char* Landmarks[] = {
    "Town Hall",      "Grand Hotel",    "Central Library", "Court House",    "City Museum",
    "Opera House",    "Post Office",    "Savings Bank",    "Exchange Tower", "Harbour Authority",
    "Public Theatre", "Grammar School", "General Store",   "University",     "Music Academy",
    "Old Brewery",    "Medical Centre", "Market Hall",     "Fire Station",   "Police Station",
    "Art Gallery",    "Natural Museum", "Tax Office",      "Radio House"};

} // namespace

std::string streetName(int axis, unsigned int index)
{
    const std::size_t count = std::size(Streets[axis]);
    const std::string name = Streets[axis][index % count];
    return index < count ? name : name + " " + std::to_string(index / count + 1);
}

std::string landmarkName(unsigned int index)
{
    return index < std::size(Landmarks) ? Landmarks[index] : "";
}

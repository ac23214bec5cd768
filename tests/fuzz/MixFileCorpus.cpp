// SPDX-License-Identifier: MIT
// MixFileCorpus <folder>: writes two mixes that say all that a mix can.
#include <fstream>
#include <iostream>

namespace
{

constexpr char Near[] = R"({
  "renderings": [
    { "name": "phong", "range": [0, 0, 4, 6], "uniforms": { "gloss": 60 } },
    { "name": "toon", "range": [4, 6, "inf", "inf"] }
  ],
  "points": [[0, 0, 1], [8, 0, 1]], "mode": "polyline", "base": "phong", "show": "lines"
})";

constexpr char Own[] = R"({
  "renderings": [{
    "name": "own", "range": [0],
    "vertex": "void main() { gl_Position = ftransform(); }",
    "fragment": ["uniform float a; // = 2\n", "void main() { gl_FragColor = vec4(a); }"],
    "defines": { "STEPS": "8" }, "attributes": { "x": 3 }, "outputs": { "c": 0 },
    "textures": [{ "unit": 1, "file": "wood.png", "wrap": [1, 2, 3], "target": 3553 }]
  }], // a comment
  "background": "0 0 1 0.5", "excess": "normalise", "watch": true, "settle": 3,
  "lighting": "own", "input": "frame" /* the end */
})";

} // namespace

int main(int argc, char** argv)
{
    if (argc != 2)
    {
        std::cerr << "MixFileCorpus: name the folder to write to\n";
        return 2;
    }
    const std::string folder = argv[1];
    std::ofstream(folder + "/near", std::ios::binary) << Near;
    std::ofstream(folder + "/own", std::ios::binary) << Own;
    return 0;
}

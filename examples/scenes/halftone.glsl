// SPDX-License-Identifier: MIT
// An image shader as web sites have them: ink dots of the picture's darkness, on paper.

const float Cell = 7.0;                         // pixels
const mat2 Turn = mat2(0.8, 0.6, -0.6, 0.8);    // so that rows of dots do not follow the pixels
const vec3 Paper = vec3(0.97, 0.95, 0.88);
const vec3 Ink = vec3(0.1, 0.12, 0.3);

void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    vec2 at = Turn * fragCoord / Cell;
    vec2 middle = (floor(at) + 0.5) * Turn * Cell / iResolution.xy; // by the transposed, its inverse
    float light = dot(texture(iChannel0, middle).rgb, vec3(0.299, 0.587, 0.114));
    float radius = 0.72 * sqrt(1.0 - light);
    float edge = 1.0 - smoothstep(radius - 0.12, radius + 0.12, length(fract(at) - 0.5));
    fragColor = vec4(mix(Paper, Ink, edge), 1.0);
}

#version 330
// Pixels from the middle of the piece of the photograph, so that they are as exact as floats can be.
layout(location = 0) in vec2 position;
uniform vec2 osgPagedTexture_pieceSize;
flat out vec2 corner;

void main()
{
    corner = position;
    gl_Position = vec4(position * (2.0 / osgPagedTexture_pieceSize), 0.0, 1.0);
}

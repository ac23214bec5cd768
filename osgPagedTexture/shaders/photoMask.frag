#version 330
out vec4 used;

void main()
{
    used = vec4(1.0);
}

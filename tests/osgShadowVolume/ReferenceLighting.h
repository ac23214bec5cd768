// SPDX-License-Identifier: MIT
#pragma once

#include <osg/Group>
#include <osg/Image>
#include <osg/Light>
#include <osg/Matrixd>

#include <vector>

/// One surface under lights, in world coordinates: for the CPU to compute and for OSG to draw.
struct ReferenceScene
{
    enum class Shape
    {
        Plane, ///< z = 0, |x| and |y| up to 2, normal +z.
        Sphere ///< Around the origin, of radius 1.
    };

    Shape shape = Shape::Plane;
    std::vector<osg::ref_ptr<osg::Light>> lights;
    osg::Vec4 ambient{0.3f, 0.2f, 0.25f, 1.0f}; ///< Of the material, as all that follow.
    osg::Vec4 diffuse{0.8f, 0.7f, 0.6f, 1.0f};
    osg::Vec4 specular{0.4f, 0.5f, 0.3f, 1.0f};
    osg::Vec4 emission{0.02f, 0.0f, 0.04f, 1.0f};
    float shininess = 24.0f;
    osg::Vec4 sceneAmbient{0.2f, 0.2f, 0.3f, 1.0f}; ///< Of the LightModel.
    bool localViewer = false;

    osg::Matrixd view;       ///< World to eye, rigid.
    osg::Matrixd projection; ///< Eye to clip, invertible.

    /// The same for OSG: the shape, its material and light model, a LightSource for each light.
    ///
    /// The plane is one quad. The sphere is a mesh of 512 x 256 quads, whose interpolated unit
    /// normal belongs exactly to the point of the mesh; that point is within 2e-5 of the sphere
    /// along the ray where the ray meets it head on, 2e-4 where it does at 85 degrees. So the
    /// normal is off by 2e-4 at most, which shifts a highlight of exponent 128 by 0.4/255.
    osg::ref_ptr<osg::Group> createNode() const;
};

/// A picture, and the pixels of it where a small move decides: silhouettes, rims of light cones.
struct ReferencePicture
{
    osg::ref_ptr<osg::Image> image; ///< RGBA8, row 0 at the bottom.
    std::vector<bool> undecided;    ///< Row by row; there the picture is no measure.

    double getUndecidedShare() const;
};

/// Renders the scene ray by ray, through the centers of the pixels, in double.
///
/// The lighting equation of OpenGL 2.1, section 2.14.1, is evaluated at each point that a ray
/// meets, with the true normal. Pixels whose color changes by more than 1/255 within `move` of a
/// pixel are undecided; 0 leaves the four further rays out. Uses all cores.
ReferencePicture renderReference(const ReferenceScene& scene, int width, int height,
                                 const osg::Vec4& background, double move = 0.02);

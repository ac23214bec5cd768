// SPDX-License-Identifier: MIT
#include "Inventor.h"

#include <osg/Geometry>
#include <osg/NodeVisitor>
#include <osg/Texture2D>
#include <osgDB/fstream>

namespace
{

class Writer : public osg::NodeVisitor
{
public:
    explicit Writer(std::ostream& out) : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), _out(out)
    {
        _out.precision(9);
        // Inventor's y is up.
        _out << "#Inventor V2.1 ascii\nSeparator {\nRotation { rotation 1 0 0 -1.57079633 }\n"
                "LightModel { model BASE_COLOR }\n"
                "BaseColor { rgb 1 1 1 }\n";
    }
    ~Writer() override { _out << "}\n"; }

    void apply(osg::Drawable& drawable) override
    {
        const auto* texture = static_cast<const osg::Texture2D*>(
            drawable.getStateSet()->getTextureAttribute(0, osg::StateAttribute::TEXTURE));
        const bool repeats = texture->getWrap(osg::Texture::WRAP_S) == osg::Texture::REPEAT;
        const char* const wrap = repeats ? "REPEAT" : "CLAMP";
        _out << "Separator {\nTexture2 { filename \"" << texture->getImage()->getFileName()
             << "\" wrapS " << wrap << " wrapT " << wrap << " }\n";
        const osg::Geometry& geometry = *drawable.asGeometry();
        _out << "Coordinate3 { point [";
        for (const osg::Vec3& at : static_cast<const osg::Vec3Array&>(*geometry.getVertexArray()))
            _out << ' ' << at.x() << ' ' << at.y() << ' ' << at.z() << ',';
        _out << " ] }\nTextureCoordinate2 { point [";
        for (const osg::Vec2& at :
             static_cast<const osg::Vec2Array&>(*geometry.getTexCoordArray(0)))
            _out << ' ' << at.x() << ' ' << at.y() << ',';
        _out << " ] }\nIndexedFaceSet { coordIndex [ 0, 1, 2, 3, -1 ] }\n}\n";
    }

private:
    std::ostream& _out;
};

} // namespace

bool writeInventor(osg::Node& town, const std::string& file)
{
    osgDB::ofstream out(file.c_str(), std::ios::binary);
    {
        Writer writer(out);
        town.accept(writer);
    }
    return bool(out.flush());
}

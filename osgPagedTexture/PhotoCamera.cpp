// SPDX-License-Identifier: MIT
#include <osgPagedTexture/PhotoCamera.h>

#include <Eigen/Dense>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace osgPagedTexture
{

namespace
{

using Space = Eigen::Matrix<double, 3, Eigen::Dynamic>;

/// Moves and scales points so that equations over them are well conditioned (R. Hartley, 1997).
struct Normalizer
{
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    double scale = 1.0;

    explicit Normalizer(const Space& points)
    {
        if (points.cols() == 0)
            return;
        middle = points.rowwise().mean();
        const double spread = std::sqrt((points.colwise() - middle).colwise().squaredNorm().mean());
        scale = spread > 0.0 ? std::sqrt(3.0) / spread : 1.0;
    }
    Eigen::Vector3d operator()(const Eigen::Vector3d& point) const
    {
        return (point - middle) * scale;
    }
    Eigen::Matrix4d matrix() const
    {
        Eigen::Matrix4d made = Eigen::Matrix4d::Identity() * scale;
        made.topRightCorner<3, 1>() = -scale * middle;
        made(3, 3) = 1.0;
        return made;
    }
};

struct Correspondences
{
    Space places, pixels;
    explicit Correspondences(const std::vector<PhotoPoint>& points)
        : places(3, Eigen::Index(points.size())), pixels(3, Eigen::Index(points.size()))
    {
        for (Eigen::Index i = 0; i < places.cols(); ++i)
        {
            const PhotoPoint& point = points[std::size_t(i)];
            places.col(i) << point.place.x, point.place.y, point.place.z;
            pixels.col(i) << point.pixel.x, point.pixel.y, 0.0;
        }
    }
};

/// The direct linear transform: rows of a projection of points (x, y, z, 1), of which `used` say
/// which count.
Eigen::Matrix<double, 3, 4> solveProjection(const Space& places, const Space& pixels,
                                            const std::vector<int>& used)
{
    const auto width = Eigen::Index(used.size());
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(3 * width, 3 * width);
    for (Eigen::Index i = 0; i < places.cols(); ++i)
    {
        const Eigen::Vector4d point = places.col(i).homogeneous();
        Eigen::MatrixXd equations = Eigen::MatrixXd::Zero(2, 3 * width);
        for (Eigen::Index k = 0; k < width; ++k)
        {
            const double value = point[used[std::size_t(k)]];
            for (int axis = 0; axis < 2; ++axis)
            {
                equations(axis, axis * width + k) = value;
                equations(axis, 2 * width + k) = -pixels(axis, i) * value;
            }
        }
        normal += equations.transpose() * equations;
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(normal);
    const Eigen::VectorXd solved = solver.eigenvectors().col(0);
    Eigen::Matrix<double, 3, 4> rows = Eigen::Matrix<double, 3, 4>::Zero();
    for (int row = 0; row < 3; ++row)
        for (Eigen::Index k = 0; k < width; ++k)
            rows(row, used[std::size_t(k)]) = solved[row * width + k];
    return rows;
}

void setRows(PhotoCamera& camera, const Eigen::Matrix<double, 3, 4>& rows)
{
    for (int row = 0; row < 3; ++row)
        camera.rows[std::size_t(row)] = {rows(row, 0), rows(row, 1), rows(row, 2), rows(row, 3)};
}

/// w is made positive for the points; infinite where it changes its sign among them.
void judge(PhotoCamera& camera, const std::vector<PhotoPoint>& points)
{
    std::size_t before = 0;
    for (const PhotoPoint& point : points)
        before += camera.project(point.place).z > 0.0;
    if (2 * before < points.size())
    {
        for (glm::dvec4& row : camera.rows)
            row = -row;
        before = points.size() - before;
    }
    double sum = before == points.size() ? 0.0 : std::numeric_limits<double>::infinity();
    for (const PhotoPoint& point : points)
    {
        const glm::dvec3 seen = camera.project(point.place);
        const glm::dvec2 off = glm::dvec2(seen) / seen.z - point.pixel;
        sum += glm::dot(off, off);
    }
    camera.error = std::sqrt(sum / double(std::max<std::size_t>(points.size(), 1)));
    if (std::isnan(camera.error))
        camera.error = std::numeric_limits<double>::infinity();
}

/// In coordinates along the main axes of the points, of which a plane has no third.
PhotoCamera fitProjection(const std::vector<PhotoPoint>& points)
{
    constexpr double Flat = 1e-4; // Thickness of a plane, of its width.
    Correspondences all(points);
    const Normalizer ofPlaces(all.places), ofPixels(all.pixels);
    Space places(3, all.places.cols()), pixels(3, all.pixels.cols());
    for (Eigen::Index i = 0; i < places.cols(); ++i)
    {
        places.col(i) = ofPlaces(all.places.col(i));
        pixels.col(i) = ofPixels(all.pixels.col(i));
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(
        Eigen::Matrix3d(places * places.transpose()));
    Eigen::Matrix3d turn; // The widest axis first.
    turn << axes.eigenvectors().col(2).transpose(), axes.eigenvectors().col(1).transpose(),
        axes.eigenvectors().col(0).transpose();
    const bool flat = axes.eigenvalues()[0] < Flat * Flat * axes.eigenvalues()[2];
    const Eigen::Matrix<double, 3, 4> rows = solveProjection(
        turn * places, pixels, flat ? std::vector<int>{0, 1, 3} : std::vector<int>{0, 1, 2, 3});
    Eigen::Matrix4d turned = Eigen::Matrix4d::Identity();
    turned.topLeftCorner<3, 3>() = turn;
    Eigen::Matrix3d toPixels = Eigen::Matrix3d::Identity();
    toPixels(0, 0) = toPixels(1, 1) = 1.0 / ofPixels.scale;
    toPixels(0, 2) = ofPixels.middle.x();
    toPixels(1, 2) = ofPixels.middle.y();
    PhotoCamera camera;
    camera.kind = flat ? PhotoCamera::Kind::Plane : PhotoCamera::Kind::Perspective;
    setRows(camera, toPixels * rows * turned * ofPlaces.matrix());
    judge(camera, points);
    return camera;
}

PhotoCamera fitAffine(const std::vector<PhotoPoint>& points)
{
    const Correspondences all(points);
    const Normalizer ofPlaces(all.places);
    Eigen::MatrixXd places(all.places.cols(), 4);
    for (Eigen::Index i = 0; i < places.rows(); ++i)
        places.row(i) = ofPlaces(all.places.col(i)).homogeneous().transpose();
    // The least of the solutions where points leave some open, as those of a line do.
    const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver(places);
    Eigen::Matrix<double, 3, 4> rows = Eigen::Matrix<double, 3, 4>::Zero();
    for (int axis = 0; axis < 2 && places.rows() > 0; ++axis)
        rows.row(axis) = solver.solve(all.pixels.row(axis).transpose()).transpose();
    rows(2, 3) = 1.0;
    PhotoCamera camera;
    setRows(camera, rows * ofPlaces.matrix());
    judge(camera, points);
    return camera;
}

} // namespace

glm::dvec3 PhotoCamera::project(const glm::dvec3& place) const
{
    const glm::dvec4 point(place, 1.0);
    return {glm::dot(rows[0], point), glm::dot(rows[1], point), glm::dot(rows[2], point)};
}

PhotoCamera fitCamera(const std::vector<PhotoPoint>& points, double largestError)
{
    constexpr std::size_t Least = 6; // Two equations each for eleven numbers.
    if (points.size() >= Least)
    {
        const PhotoCamera camera = fitProjection(points);
        if (camera.error <= largestError)
            return camera;
    }
    return fitAffine(points);
}

std::vector<PhotoPoint> pointsOf(const Photo& photo, std::size_t most)
{
    std::vector<PhotoPoint> points;
    for (const PhotoSurface& surface : photo.surfaces)
    {
        const std::size_t step =
            std::max<std::size_t>(surface.places.size() / std::max<std::size_t>(most, 1), 1);
        for (std::size_t i = 0; i < surface.places.size(); i += step)
            points.push_back({surface.places[i], glm::dvec2(surface.coordinates[i]) *
                                                     glm::dvec2(photo.width, photo.height)});
    }
    return points;
}

std::vector<PhotoPoint> seamPointsOf(const std::vector<Photo>& photos,
                                     const std::vector<PhotoSeam>& seams, std::size_t photo,
                                     std::size_t neighbour)
{
    std::vector<PhotoPoint> points;
    for (const PhotoSeam& seam : seams)
    {
        for (std::size_t side = 0; side < 2; ++side)
        {
            if (seam.sides[side].photo != photo || seam.sides[1 - side].photo != neighbour)
                continue;
            const glm::dvec2 size(photos[photo].width, photos[photo].height);
            points.push_back({seam.from, glm::dvec2(seam.sides[side].from) * size});
            points.push_back({seam.to, glm::dvec2(seam.sides[side].to) * size});
        }
    }
    return points;
}

} // namespace osgPagedTexture

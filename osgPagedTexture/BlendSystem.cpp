// SPDX-License-Identifier: MIT
#include <osgPagedTexture/BlendSystem.h>

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/Sparse>

#include <algorithm>
#include <stdexcept>

namespace osgPagedTexture
{

namespace
{

using Matrix = Eigen::SparseMatrix<double>;
using Triplet = Eigen::Triplet<double>;

/// Of a pixel of seam against a step between two neighbours of the grid.
constexpr double SeamWeight = 1.0;
/// Makes the equations have one solution; see center().
constexpr double Anchor = 1e-7;

/// Samples one after the other that lie in the same cells, taken together.
struct SampleRun
{
    std::array<std::size_t, 2> photos{};
    std::array<glm::ivec2, 2> cells{};
    std::array<glm::dvec2, 2> places{glm::dvec2(0.0), glm::dvec2(0.0)};
    glm::dvec3 step{0.0};
    int count = 0;

    bool takes(const SampleRun& other) const
    {
        return count > 0 && photos == other.photos && cells == other.cells;
    }
    void add(const SampleRun& other)
    {
        for (std::size_t side = 0; side < 2; ++side)
            places[side] += other.places[side];
        step += other.step;
        count += other.count;
    }
};

class Assembly
{
public:
    explicit Assembly(const BlendGrid& grid)
        : _grid(grid), _rightSides(Eigen::MatrixXd::Zero(Eigen::Index(grid.getCount()), 3))
    {
    }

    void addSmoothness()
    {
        for (std::size_t photo = 0; photo < _grid.getMaps().size(); ++photo)
        {
            const CellMap& map = _grid.getMaps()[photo];
            for (int y = 0; y < map.rows; ++y)
                for (int x = 0; x < map.columns; ++x)
                    if (map.at(x, y) != 0)
                        addCell(_grid.cornersOf(photo, x, y));
        }
        for (std::size_t i = 0; i < _grid.getCount(); ++i)
            _triplets.emplace_back(int(i), int(i), Anchor);
    }

    void addSeams(const std::vector<SeamSample>& samples)
    {
        SampleRun run;
        for (const SeamSample& sample : samples)
        {
            SampleRun next;
            for (std::size_t side = 0; side < 2; ++side)
            {
                next.photos[side] = sample.sides[side].photo;
                next.places[side] = sample.sides[side].place;
                next.cells[side] = _grid.getMaps()[next.photos[side]].cellAt(next.places[side]);
            }
            next.step = glm::dvec3(sample.sides[1].color) - glm::dvec3(sample.sides[0].color);
            next.count = 1;
            if (!run.takes(next))
            {
                addRun(run);
                run = SampleRun();
                run.photos = next.photos;
                run.cells = next.cells;
            }
            run.add(next);
        }
        addRun(run);
    }

    Matrix matrix() const
    {
        Matrix made(Eigen::Index(_grid.getCount()), Eigen::Index(_grid.getCount()));
        made.setFromTriplets(_triplets.begin(), _triplets.end());
        return made;
    }
    const Eigen::MatrixXd& rightSides() const { return _rightSides; }

private:
    /// Half an edge for each of the two cells that share it.
    void addCell(const std::array<std::int64_t, 4>& corners)
    {
        constexpr std::size_t Edges[4][2] = {{0, 1}, {2, 3}, {0, 2}, {1, 3}};
        for (const auto& edge : Edges)
        {
            const int a = int(corners[edge[0]]), b = int(corners[edge[1]]);
            _triplets.emplace_back(a, a, 0.5);
            _triplets.emplace_back(b, b, 0.5);
            _triplets.emplace_back(a, b, -0.5);
            _triplets.emplace_back(b, a, -0.5);
        }
    }

    void addRun(const SampleRun& run)
    {
        if (run.count == 0)
            return;
        std::array<CellCorners, 2> corners;
        for (std::size_t side = 0; side < 2; ++side)
            if (!_grid.find(run.photos[side], run.places[side] / double(run.count), corners[side]))
                return;
        const double weight = SeamWeight * run.count;
        for (std::size_t i = 0; i < 8; ++i)
        {
            const auto [row, share] = entry(corners, i);
            for (std::size_t j = 0; j < 8; ++j)
            {
                const auto [column, other] = entry(corners, j);
                _triplets.emplace_back(row, column, weight * share * other);
            }
            for (int channel = 0; channel < 3; ++channel)
                _rightSides(row, channel) += weight * share * run.step[channel] / double(run.count);
        }
    }

    /// The first photograph's four values count up, the other's down.
    static std::pair<int, double> entry(const std::array<CellCorners, 2>& corners, std::size_t i)
    {
        const CellCorners& side = corners[i / 4];
        return {int(side.values[i % 4]), i < 4 ? side.shares[i % 4] : -side.shares[i % 4]};
    }

    const BlendGrid& _grid;
    std::vector<Triplet> _triplets;
    Eigen::MatrixXd _rightSides;
};

void solveDirectly(const Matrix& matrix, const Eigen::MatrixXd& rightSides, BlendValues& values)
{
    const Eigen::SimplicialLDLT<Matrix> factors(matrix);
    if (factors.info() != Eigen::Success)
        throw std::runtime_error("the colours at the seams give no correction: the equations "
                                 "can't be solved");
    for (int channel = 0; channel < 3; ++channel)
    {
        const Eigen::VectorXd solved = factors.solve(rightSides.col(channel));
        std::copy(solved.begin(), solved.end(), values[std::size_t(channel)].begin());
    }
}

BlendSolution iterate(const Matrix& matrix, const Eigen::MatrixXd& rightSides, BlendValues& values,
                      int iterations, double error)
{
    Eigen::ConjugateGradient<Matrix, Eigen::Lower | Eigen::Upper, Eigen::IncompleteCholesky<double>>
        solver(matrix);
    solver.setMaxIterations(iterations);
    solver.setTolerance(error);
    BlendSolution solution;
    for (int channel = 0; channel < 3; ++channel)
    {
        std::vector<double>& own = values[std::size_t(channel)];
        const Eigen::Map<Eigen::VectorXd> start(own.data(), Eigen::Index(own.size()));
        const Eigen::VectorXd solved = solver.solveWithGuess(rightSides.col(channel), start);
        std::copy(solved.begin(), solved.end(), own.begin());
        solution.iterations = std::max(solution.iterations, int(solver.iterations()));
        solution.residual = std::max(solution.residual, solver.error());
    }
    return solution;
}

/// Whatever seams connect could be brighter or darker as a whole: the mean of its corrections is 0.
/// The matrix says what is connected: values that share an entry.
void center(const Matrix& matrix, BlendValues& values)
{
    std::vector<Eigen::Index> group(std::size_t(matrix.cols()), -1);
    std::vector<Eigen::Index> members;
    for (Eigen::Index first = 0; first < matrix.cols(); ++first)
    {
        if (group[std::size_t(first)] >= 0)
            continue;
        members.assign(1, first);
        group[std::size_t(first)] = first;
        for (std::size_t next = 0; next < members.size(); ++next)
        {
            for (Matrix::InnerIterator entry(matrix, members[next]); entry; ++entry)
            {
                Eigen::Index& other = group[std::size_t(entry.row())];
                if (other >= 0)
                    continue;
                other = first;
                members.push_back(entry.row());
            }
        }
        for (std::vector<double>& channel : values)
        {
            double sum = 0.0;
            for (Eigen::Index each : members)
                sum += channel[std::size_t(each)];
            for (Eigen::Index each : members)
                channel[std::size_t(each)] -= sum / double(members.size());
        }
    }
}

} // namespace

BlendSolution solveBlend(const BlendGrid& grid, const std::vector<SeamSample>& samples,
                         BlendValues& values, int iterations, double error, bool direct)
{
    Assembly assembly(grid);
    assembly.addSmoothness();
    assembly.addSeams(samples);
    const Matrix matrix = assembly.matrix();
    BlendSolution solution;
    if (direct)
        solveDirectly(matrix, assembly.rightSides(), values);
    else
        solution = iterate(matrix, assembly.rightSides(), values, iterations, error);
    center(matrix, values);
    return solution;
}

} // namespace osgPagedTexture

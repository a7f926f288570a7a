/// One hexahedron of a Gmsh file: where its nodes are, and whether they make a cell.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace tribogel
{

using Place = std::array<double, 3>; ///< [mm]

/// Gmsh's order: corners, then the middles of these edges, of these faces, and that of the cell.
inline constexpr int gmsh_edge[12][2] = {{0, 1}, {0, 3}, {0, 4}, {1, 2}, {1, 5}, {2, 3},
                                         {2, 6}, {3, 7}, {4, 5}, {4, 7}, {5, 6}, {6, 7}};
inline constexpr int gmsh_face[6][4] = {{0, 3, 2, 1}, {0, 1, 5, 4}, {0, 4, 7, 3},
                                        {1, 2, 6, 5}, {2, 3, 7, 6}, {4, 5, 6, 7}};

/// Gmsh's corners in lexicographic order.
inline constexpr int gmsh_corner[8] = {0, 1, 3, 2, 4, 5, 7, 6};

/// The corners of the node's edge, face or cell, or itself; of 27, in Gmsh's order.
std::vector<int> corners_of_node(int node);

/// All 27 nodes in Gmsh's order from the 8, 20 or 27 that are given: of 8 the means, of 20 what the
/// serendipity shape functions put there.
std::array<Place, 27> all_nodes(const std::vector<Place> &given);

/// Whether the corners are those of a mirrored cell.
bool is_left_handed(const std::array<Place, 27> &node);

/// Why elements of this order cannot be made of it; empty if they can. Complete but for its subject, "element
/// 7 ".
std::string fault_of(const std::array<Place, 27> &node, std::size_t given, int order);

/// For messages.
std::string five_digits(double value);
std::string in_words(const Place &X);

/// "40, e.g. " or nothing, before one of so many.
std::string in_number(std::size_t count);

double distance(const Place &a, const Place &b);

} // namespace tribogel

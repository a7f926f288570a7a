/// Gmsh files in all the ways in which Gmsh writes them, and in words what cannot be read.
#include "gmsh_texts.hpp"

namespace tribogel::test
{

namespace
{

/// Two coaxial ones.
SerialMesh cylinders()
{
  Scene scene = paper_scene(3, 1);
  scene.model = Model::solid;
  scene.mesh.grading = 1;
  return revolved_mesh(meridian_blocks(scene));
}

void expect_equal(const SerialMesh &one, const SerialMesh &other)
{
  EXPECT_EQ(one.vertex, other.vertex);
  EXPECT_EQ(one.middle, other.middle);
  ASSERT_EQ(one.cell.size(), other.cell.size());
  for (std::size_t k = 0; k < one.cell.size(); ++k) {
    EXPECT_EQ(one.cell[k].vertex, other.cell[k].vertex);
    EXPECT_EQ(one.cell[k].body, other.cell[k].body);
  }
  ASSERT_EQ(one.boundary.size(), other.boundary.size());
  for (std::size_t k = 0; k < one.boundary.size(); ++k) {
    EXPECT_EQ(one.boundary[k].vertex, other.boundary[k].vertex);
    EXPECT_EQ(one.boundary[k].side, other.boundary[k].side);
  }
}

/// Of the text: the sections that begin at `$first` and at `$second` behind it, in the other order.
std::string exchanged(const std::string &text, const std::string &first, const std::string &second)
{
  const auto section = [&](const std::string &name) {
    const auto from = text.find("$" + name + "\n"), end = text.find("$End" + name + "\n") + name.size() + 5;
    return std::pair{from, end};
  };
  const auto [a, b] = section(first);
  const auto [c, d] = section(second);
  return text.substr(0, a) + text.substr(c, d - c) + text.substr(b, c - b) + text.substr(a, b - a) +
         text.substr(d);
}

/// Of format 2.2 with nodes on points (the point's number follows) and surfaces (and two parameters).
std::string with_parameters(const std::string &text)
{
  std::istringstream lines(text);
  std::string line, result;
  bool among_nodes = false;
  for (int k = 0; std::getline(lines, line); ++k) {
    among_nodes = (among_nodes || line == "$Nodes") && line != "$EndNodes";
    const bool places = among_nodes && line.find(' ') != std::string::npos;
    result += line + (!places ? "\n" : k % 2 ? " 0 5\n" : " 2 13 0.5 -0.25\n");
  }
  return replaced(replaced(result, "$Nodes", "$ParametricNodes"), "$EndNodes", "$EndParametricNodes");
}

std::string with_carriage_returns(std::string text)
{
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2) text.insert(at, "\r");
  return text;
}

} // namespace

/// Whatever the way in which a file of Gmsh's says it, the mesh is the same.
TEST(gmsh_file, IsTheSameInAllThatGmshWrites)
{
  const SerialMesh serial = cylinders();
  const GmshWriter writer(serial, Arrangement::gel_on_gel, 8);
  const std::string two = writer.format_2(), four = writer.format_4(), parts = writer.partitioned();
  const SerialMesh mesh = read(two, 1);
  for (const std::string &text :
       {four, parts, with_parameters(two), exchanged(two, "PhysicalNames", "Elements"),
        exchanged(four, "PhysicalNames", "Elements"), exchanged(two, "Nodes", "Elements"),
        exchanged(parts, "Nodes", "Elements"), with_carriage_returns(two), with_carriage_returns(parts),
        "\xEF\xBB\xBF" + two})
    expect_equal(read(text, 1), mesh);
}

/// What is missing is named beside what there is.
TEST(gmsh_file, ListsTheGroupsThatItHas)
{
  const SerialMesh mesh = cubes();
  const GmshWriter writer(mesh, Arrangement::gel_on_gel, 8);
  const std::string two = writer.format_2(), four = writer.format_4();
  const std::string surfaces = "surfaces 'top_plate', 'bottom_plate', 'top_contact', 'bottom_contact'";
  for (const std::string &text : {two, four, exchanged(two, "PhysicalNames", "Elements")}) {
    expect_refusal(refusal(replaced(text, "\"bottom\"", "\"Bottom\"")),
                   "no physical volume 'bottom'; there is a volume 'Bottom': names are taken to the letter; "
                   "the file has "
                   "volumes 'Bottom', 'top' and " +
                       surfaces);
    expect_refusal(refusal(replaced(text, "\"top_contact\"", "\"top contact \"")),
                   "there is a surface 'top contact ': names are taken to the letter");
    expect_refusal(refusal(replaced(text, "\"bottom\"", "\"gel\"")),
                   "no physical volume 'bottom'; the file has volumes 'gel', 'top' and " + surfaces);
    expect_refusal(refusal(replaced(replaced(text, "\"top\"", "\"lid\""), "\"top_plate\"", "\"top\"")),
                   "no physical volume 'top'; 'top' is a surface; the file has volumes 'bottom', 'lid' and");
    expect_refusal(refusal(replaced(text, "\n3 2 \"top\"\n", "\n1 2 \"top\"\n")),
                   "no physical volume 'top'; the file has volumes 'bottom', number 2 (no name) and ");
  }
  std::string saved_all = two;
  for (std::size_t at = 0; (at = saved_all.find(" 2 1 7 ", at)) != std::string::npos;)
    saved_all.replace(at, 7, " 2 0 7 ");
  expect_refusal(refusal(saved_all),
                 "no physical volume 'bottom'; the file names it, but no element is in it");
  expect_refusal(refusal(saved_all), "volumes 'bottom' (no element), 'top' and ");
  const auto names = two.find("$PhysicalNames"), end = two.find("$Nodes");
  std::string nameless = two.substr(0, names) + two.substr(end);
  expect_refusal(refusal(nameless),
                 "volumes number 1 (no name), number 2 (no name) and surfaces number 3 (no name), ");
  for (const char *group : {" 2 1 7 ", " 2 2 7 ", " 2 3 7 ", " 2 4 7 ", " 2 5 7 ", " 2 6 7 "})
    nameless = replaced(nameless, group, " 2 0 7 ");
  expect_refusal(refusal(nameless), "the file has no physical groups");
}

/// Files of other programs, and of Gmsh in ways that are not read.
TEST(gmsh_file, KnowsOtherFilesByTheirHeads)
{
  const SerialMesh mesh = cubes();
  const GmshWriter writer(mesh, Arrangement::gel_on_gel, 8);
  for (const auto &[head, part] : std::initializer_list<std::pair<const char *, const char *>>{
           {"(1 \"meshio 5.3.4\")\n(2 3)\n",
            "line 1: no section begins here (as in meshes of ANSYS Fluent, which meshio"},
           {"*Heading\n", "Abaqus"},
           {" MeshVersionFormatted 2\n", "Medit"},
           {"# vtk DataFile Version 2.0\n", "VTK"},
           {"<?xml version=\"1.0\"?>\n", "XML"},
           {"$ Created by Gmsh\nGRID 1\n", "line 1: no section begins here (as in input of Nastran)"},
           {"\x89HDF\r\n\x1a\n", "HDF5"},
           {"CDF\x01\n", "netCDF"},
           {"$NOD\n1\n1 0 0 0\n$ENDNOD\n", "line 1: format 1"},
           {"$MeshFormat\n4 0 8\n$EndMeshFormat\n", "line 2: format 4;"},
           {"$MeshFormat\n4.1 1 8\n\x01", "line 2: a binary file (gmsh OLD.msh -save -o NEW.msh"},
           {"\n\n", "no $MeshFormat"}})
    expect_refusal(refusal(head), part);
  expect_refusal(refusal(writer.partitioned({2})), "holds 1 of the 2 parts into which the mesh was cut");
}

} // namespace tribogel::test

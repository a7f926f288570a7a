#include "probe.hpp"
namespace tribogel::test
{
namespace
{
struct Iterate { double norm, floor, size; std::vector<int> status; };
struct Log : Observer {
  Problem *problem=nullptr; std::vector<Iterate> now;
  PetscErrorCode Start(Problem &) override { return 0; }
  PetscErrorCode Step(Problem &p, const StepReport &) override {
    if (getenv("VC")) {
      printf("VC step phase %d t %.4g dt %.3g:", p.state.phase, p.state.time, p.state.step);
      std::size_t first = now.size()-1; while(first>0 && now[first-1].status==now.back().status) --first;
      printf(" settled %zu |", first);
      for (auto &i: now) printf(" %.2e", i.norm/i.size);
      printf(" floor %.1e size %.2e\n", now.back().floor/now.back().size, now.back().size);
    }
    return 0;
  }
};
PetscErrorCode Monitor(SNES snes, PetscInt k, PetscReal norm, void *ctx)
{
  Log &log = *static_cast<Log*>(ctx);
  if (k==0) log.now.clear();
  (void)snes;
  Problem &p = *log.problem;
  Values m = Probe::values(p.magnitude), r = Probe::values(p.round_off);
  double mm=0, rr=0; for (double x: m) mm+=x*x; for (double x: r) rr+=x*x;
  Iterate it; it.norm=norm; it.size=std::sqrt(mm); it.floor=16*(std::sqrt(rr)+2.2e-16*it.size);
  NodeBlock block;
  for (std::size_t a=0;a<p.contact->model().reference().nodes.size();++a) { if(!p.contact->model().reference().nodes[a].carries) continue; p.contact->model().node((int)a,p.scene.friction,block); it.status.push_back((int)block.status);}
  log.now.push_back(it);
  return 0;
}
}
TEST(newton, IsQuadratic)
{
  Options options({{"-snes_rtol","1e-14"},{"-ts_atol","1e-2"}});
  Problem problem; Log log; log.problem=&problem;
  ASSERT_EQ(problem.SetUp(PETSC_COMM_WORLD, paper_scene(6)),0);
  SNES snes; TSGetSNES(problem.ts,&snes); SNESMonitorSet(snes,Monitor,&log,nullptr);
  bool completed; std::string why;
  ASSERT_EQ(problem.Run({&log},completed,why),0);
}
}

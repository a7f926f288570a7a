#include "probe.hpp"
namespace tribogel::test
{
namespace
{
struct Iterate { double norm, floor, size; std::vector<int> status; Values U; };
struct Log : Observer {
  Problem *problem=nullptr; std::vector<Iterate> now;
  PetscErrorCode Start(Problem &) override { return 0; }
  PetscErrorCode Step(Problem &p, const StepReport &) override {
    if (getenv("VC")) {
      printf("VC step phase %d t %.4g dt %.3g:", p.state.phase, p.state.time, p.state.step);
      std::size_t first = now.size()-1; while(first>0 && now[first-1].status==now.back().status) --first;
      printf(" settled %zu |", first);
      for (auto &i: now) printf(" %.2e", i.norm/i.size);
      auto err=[&](std::size_t k,int lo,int hi){double e=0;for(std::size_t i=0;i<p.group.size();++i) if(p.group[i]>=lo&&p.group[i]<hi) e+=std::pow(now[k].U[i]-now.back().U[i],2); return std::sqrt(e/p.group.size());};
      int above=0; for(std::size_t k=first;k<now.size();++k) above+=now[k].norm>now[k].floor;
      double CR=0,CU=0,CT=0; for(std::size_t k=first;k+1<now.size()&&now[k+1].norm>now[k+1].floor;++k){CR=std::max(CR,now[k+1].norm/std::pow(now[k].norm,2));CU=std::max(CU,err(k+1,0,3)/std::pow(err(k,0,3),2));CT=std::max(CT,err(k+1,0,6)/std::pow(err(k,0,6),2));}
      printf(" | u"); for(std::size_t k=0;k<now.size();++k) printf(" %.2e",err(k,0,3));
      printf(" | l"); for(std::size_t k=0;k<now.size();++k) printf(" %.2e",err(k,3,6));
      printf(" | above %d CR %.3g CU %.3g CT %.3g",above,CR,CU,CT);
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
  Vec U; SNESGetSolution(snes,&U); it.U=Probe::values(U); log.now.push_back(it);
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

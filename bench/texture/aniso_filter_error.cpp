// exploration
#include <cstdio>
#include <random>
#include <string>
#include <vector>
#include <fmt/format.h>
#include "lobe_radiance.h"
#include "sateen/io/image.h"
#include "sateen/core/parallel.h"
using namespace sateen;
struct Var { std::string name; };
int main(int argc, char** argv) {
  std::vector<AnisotropicAlpha> lobes{{.3,.1,.5},{.15,.15,0},{.5,.1,.5}};
  constexpr int M = 10;
  const char* names[M] = {"naive","lean","sggx","sggxvar","sggxvar-mean","sggx-mean","sggxPI","slope2var","eig(S),2var","var c=1.5"};
  std::vector<std::pair<Vec3,Vec3>> dirs;
  for (int i=0;i<48;++i){ double u=(i+.5)/48; double tl=std::acos(std::sqrt(1-u*.98)); double pl=i*2.399963;
    for (double tv : {0.0,30.0,60.0}) { double pv=i*1.7+tv; double t=radians(tv);
      dirs.push_back({Vec3(std::sin(tl)*std::cos(pl),std::sin(tl)*std::sin(pl),std::cos(tl)),Vec3(std::sin(t)*std::cos(pv),std::sin(t)*std::sin(pv),std::cos(t))}); } }
  double total[M]{}, totalrms[M]{}, tot3[M]{}; int cells=0;
  for (int a=1;a<argc;++a) {
    Image img=read_data(argv[a]);
    double mapd[M]{}, mapr[M]{}; int mc=0;
    for (int k=1;k<=6;++k) {
      std::mt19937 rng(5);
      double ad[M]{}, sq[M]{}, rf=0, rf2=0;  
      double blockrel[M]{}; 
      int B=1<<k;
      for (auto& lobe:lobes) { const Mat2 s2=ggx_matrix(lobe);
      for (int b=0;b<12;++b) {
        int x0=int(rng()%unsigned(img.width/B))*B,y0=int(rng()%unsigned(img.height/B))*B;
        std::vector<LobeTexel> tex; int step=std::max(1,B/16);
        for(int y=0;y<B;y+=step)for(int x=0;x<B;x+=step){ Vec3 n(img.at(x0+x,y0+y,0)*2-1,img.at(x0+x,y0+y,1)*2-1,img.at(x0+x,y0+y,2)*2-1); n.z()=std::max(n.z(),.01); n.normalize(); tex.push_back({n,s2}); }
        Mat3 A=Mat3::Zero(),N=Mat3::Zero(); Vec3 m=Vec3::Zero();
        FilterOptions op; 
        float acc[4][9]{}; 
        for(auto&t:tex){ A+=sggx_matrix(t.normal,t.s)-t.normal*t.normal.transpose(); N+=t.normal*t.normal.transpose(); m+=t.normal;
          for(int q=0;q<4;++q){ op.method=FilterMethod(q); float mm[9]{}; pack_moments(t,op,std::span<float,9>(mm)); for(int i=0;i<9;++i)acc[q][i]+=mm[i]/float(tex.size()); } }
        A/=double(tex.size());N/=double(tex.size());m/=double(tex.size());
        LobeTexel f[M];
        auto un=[&](FilterMethod q,NormalSolver so=NormalSolver::eigen){ op.method=q; op.solver=so; return unpack_moments(std::span<const float,9>(acc[int(q)]),op); };
        f[0]=un(FilterMethod::naive); f[1]=un(FilterMethod::lean); f[2]=un(FilterMethod::sggx); f[3]=un(FilterMethod::sggx_variance);
        Mat3 S2=A+2*N-m*m.transpose();
        f[4].normal=m.normalized(); f[4].s=guarded(tangent_part(S2,f[4].normal));
        f[5].normal=m.normalized(); f[5].s=guarded(tangent_part(A+N,f[5].normal));
        f[6]=un(FilterMethod::sggx,NormalSolver::power_iteration);
        { // slopes about the mean normal
          Vec3 n=m.normalized(); Mat3 F=normal_frame(n); Vec2 sb(0,0); Mat2 ss=Mat2::Zero(),aa=Mat2::Zero();
          for(auto&t:tex){ Vec3 l=F.transpose()*t.normal; double z=std::max(l.z(),.2); Vec2 s=l.head<2>()/z; sb+=s; ss+=s*s.transpose(); aa+= (F.transpose()*(sggx_matrix(t.normal,t.s)-t.normal*t.normal.transpose())*F).topLeftCorner<2,2>(); }
          sb/=double(tex.size()); ss/=double(tex.size()); aa/=double(tex.size());
          f[7].normal=n; f[7].s=guarded(aa+2*(ss-sb*sb.transpose())); }
        f[8].normal=f[2].normal; f[8].s=guarded(tangent_part(S2,f[8].normal));
        Mat3 S15=A+1.5*N-.5*m*m.transpose(); f[9].normal=m.normalized(); f[9].s=guarded(tangent_part(S15,f[9].normal));
        double ref_b=0, e_b[M]{};
        for(auto&[l,v]:dirs){ double r=0; for(auto&t:tex) r+=lobe_radiance(t,l,v); r/=double(tex.size());
          rf+=r; rf2+=r*r; ref_b+=r;
          for(int q=0;q<M;++q){ double d=lobe_radiance(f[q],l,v)-r; ad[q]+=std::abs(d); sq[q]+=d*d; e_b[q]+=std::abs(d);} }
        for(int q=0;q<M;++q) blockrel[q]+=e_b[q]/std::max(ref_b,1e-9)/12/double(lobes.size());
      } }
      for(int q=0;q<M;++q){ total[q]+=ad[q]/rf; totalrms[q]+=std::sqrt(sq[q]/rf2); tot3[q]+=blockrel[q]; mapd[q]+=ad[q]/rf; mapr[q]+=std::sqrt(sq[q]/rf2);} ++cells; ++mc;
    }
    std::string p=argv[a]; p=p.substr(p.rfind('/')+1);
    fmt::print("{:34}",p.substr(0,34)); for(int q=0;q<M;++q) fmt::print(" {:5.2f}/{:5.2f}",mapd[q]/mc,mapr[q]/mc); fmt::print("\n");
  }
  for(int q=0;q<M;++q) fmt::print("{:14} L1 {:.3f} rms {:.3f} block {:.3f}\n",names[q],total[q]/cells,totalrms[q]/cells,tot3[q]/cells);
}

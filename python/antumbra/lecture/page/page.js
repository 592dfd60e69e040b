(()=>{const D=document,H=D.documentElement,$=(s,e=D)=>e.querySelector(s),$$=(s,e=D)=>[...e.querySelectorAll(s)];
H.classList.add('js');
const figs=$$('.fig'),st={fig:'',kv:{},slides:false,step:0},ctl=[];
const say=t=>$('#live').textContent=t,put=(k,v)=>{try{localStorage[k]=v}catch(e){}},got=k=>{try{return localStorage[k]}catch(e){}};
// address: #[slides/]figure[/key=value]…[/answers]
const read=()=>{const p=location.hash.slice(1).split('/').filter(Boolean).map(x=>{try{return decodeURIComponent(x)}catch(e){return x}});st.slides=p[0]=='slides'&&innerWidth>820;if(p[0]=='slides')p.shift();
 st.fig=figs.some(f=>f.id==p[0])?p[0]:'';st.kv={};p.slice(st.fig?1:0).forEach(x=>{const i=x.indexOf('=');i<0?x=='answers'&&(st.kv[x]='1'):st.kv[x.slice(0,i)]=x.slice(i+1)});return p[0]||''};
const write=()=>{const p=[];if(st.slides)p.push('slides');if(st.fig)p.push(st.fig);for(const k in st.kv)p.push(k=='answers'?k:k+'='+encodeURIComponent(st.kv[k]));history.replaceState(null,'','#'+p.join('/'))};
const set=(fig,k,v)=>{if(st.fig!=fig){const a=st.kv.answers;st.fig=fig;st.kv=a?{answers:a}:{}}st.kv[k]=v;write()};
// theme
const theme=t=>{H.dataset.theme=t;$('#b-theme').setAttribute('aria-pressed',t=='dark');put('theme',t)};
const t0=got('theme');if(t0)theme(t0);else $('#b-theme').setAttribute('aria-pressed',matchMedia('(prefers-color-scheme:dark)').matches);
$('#b-theme').onclick=e=>theme(e.currentTarget.getAttribute('aria-pressed')=='true'?'light':'dark');
// predict, then see
const open=(f,on=true)=>{f.classList.toggle('open',on);$('.ask button',f).setAttribute('aria-expanded',on)};
figs.forEach(f=>{$('.ask button',f).onclick=()=>{open(f);$('.ans',f).focus()};
 $$('.q button',f).forEach((b,i,all)=>b.onclick=()=>{all.forEach(x=>x.setAttribute('aria-pressed',x==b));const r=b.dataset.ok!=null;$('.verdict',f).textContent=r?'Yes. The number is below.':'Not so. The number is below.';open(f)})});
const answers=on=>{figs.forEach(f=>open(f,on));$('#b-answers').setAttribute('aria-pressed',on)};
$('#b-answers').onclick=e=>{const on=e.currentTarget.getAttribute('aria-pressed')!='true';answers(on);if(on)st.kv.answers='1';else delete st.kv.answers;write()};
// a slider chooses a frame of its strip; its drawing and the facts of the key follow
$$('.strip').forEach(s=>{const f=s.closest('.fig'),k=s.dataset.key,li=$$('.frames>li',s),dr=$$('.draws>svg',s),r=$('input',s),o=$('output',s);
 const show=i=>{li.forEach((l,j)=>l.classList.toggle('on',j==i));dr.forEach((d,j)=>d.classList.toggle('on',j==i));const d=li[i].dataset;const[a,z]=d.says.split(/(: .*)/),e=D.createElement('i');e.textContent=z;o.replaceChildren(a,e);r.value=i;r.setAttribute('aria-valuetext',d.says+(d.more||''));
  const F=JSON.parse(d.facts||'[]');$$('.key[data-of="'+k+'"] [data-i]',f).forEach(e=>e.textContent=F[e.dataset.i])};
 r.oninput=()=>{show(+r.value);set(f.id,k,li[r.value].dataset.v)};
 ctl.push([f.id,k,v=>{const i=li.findIndex(l=>l.dataset.v==v);show(i<0?+s.dataset.start:i)}])});
// tabs; a plot of the same figure shows the chosen curve
$$('.tabbed').forEach(s=>{const f=s.closest('.fig'),k=s.dataset.key,t=$$(':scope>.tabs>button',s),p=$$(':scope>.pan',s);
 const show=(i,focus)=>{t.forEach((b,j)=>{b.setAttribute('aria-selected',j==i);b.tabIndex=j==i?0:-1;p[j].hidden=j!=i});if(focus)t[i].focus();
  const c=$$('.plot g[data-s]',f);if(c.some(g=>g.dataset.s==t[i].dataset.v))c.forEach(g=>{const on=g.dataset.s==t[i].dataset.v;g.classList.toggle('on',on);on&&g.parentNode.append(g)})},pick=(i,focus)=>{show(i,focus);set(f.id,k,t[i].dataset.v)};
 t.forEach((b,i)=>{b.onclick=()=>pick(i);b.onkeydown=e=>{const d={ArrowRight:1,ArrowLeft:-1}[e.key];if(d){e.preventDefault();e.stopPropagation();pick((i+d+t.length)%t.length,1)}}});
 ctl.push([f.id,k,v=>show(Math.max(0,t.findIndex(b=>b.dataset.v==v)))])});
// a row and its ray are one thing
$$('.px').forEach(s=>{const f=s.closest('.fig'),k=s.dataset.key,hot=j=>{$('.scene svg',s).classList.toggle('dim',j!=null);$$('[data-j]',s).forEach(e=>e.classList.toggle('hot',e.dataset.j==j))};
 $$('[data-j]',s).forEach(e=>{e.onmouseenter=()=>hot(e.dataset.j);e.onmouseleave=()=>hot(st.fig==f.id?st.kv[k]:null);e.addEventListener('focusin',()=>hot(e.dataset.j));e.onclick=()=>{hot(e.dataset.j);set(f.id,k,e.dataset.j)}});
 ctl.push([f.id,k,hot])});
// copy
$$('.cmd button').forEach(b=>b.onclick=async()=>{const c=b.previousElementSibling;try{await navigator.clipboard.writeText(c.textContent);b.textContent='Copied'}catch(e){getSelection().selectAllChildren(c);b.textContent='Selected'}say('Command '+b.textContent.toLowerCase());setTimeout(()=>b.textContent='Copy',1600)});
// slides
const asks=f=>f.dataset.asks!=null,cur=()=>Math.max(0,figs.findIndex(f=>f.id==st.fig)),show=()=>{D.body.classList.toggle('slides',st.slides);$('#b-slides').setAttribute('aria-pressed',st.slides);const n=cur();figs.forEach((f,i)=>{f.classList.remove('cur','s0','s1','s2');if(st.slides&&i==n){f.classList.add('cur','s'+(st.step||+asks(f)));D.body.dataset.pos=(n+1)+' / '+figs.length}})};
const go=(n,s=0)=>{n=Math.min(figs.length-1,Math.max(0,n));const a=st.kv.answers;if(figs[n].id!=st.fig)st.kv=a?{answers:a}:{};st.fig=figs[n].id;st.step=s;s?st.kv.step=s:delete st.kv.step;write();show();say($('h3',figs[n]).textContent+', '+['question','picture','number'][s])};
const slides=on=>{if(!figs.length)return;st.slides=on;if(on)go(cur());else{delete st.kv.step;write();show();$('#'+(st.fig||'top')).scrollIntoView()}};
$('#b-slides').onclick=()=>{const n=figs.findIndex(f=>f.getBoundingClientRect().bottom>200);if(n>=0&&!st.slides&&figs[n].id!=st.fig){st.fig=figs[n].id;st.kv={}}slides(true)};$('#b-print').onclick=()=>print();
const next=()=>{st.step<2?go(cur(),asks(figs[cur()])?2:st.step+1):cur()<figs.length-1&&go(cur()+1)};$('#b-exit').onclick=()=>slides(false);
D.addEventListener('click',e=>{st.slides&&!e.target.closest('button,a,input,label,[data-j]')&&next()});
addEventListener('keydown',e=>{if(!st.slides||e.altKey||e.ctrlKey||e.metaKey)return;const T=e.target,k=e.key,own=T.matches('input,[role=tab]');
 if(k=='Escape')slides(false);else if((k==' '||k=='PageDown')&&!T.matches('button'))next();else if(k=='PageUp'){st.step?go(cur(),st.step-1):cur()&&go(cur()-1,2)}else if(k=='ArrowRight'&&!own)go(cur()+1);else if(k=='ArrowLeft'&&!own)go(cur()-1);else return;e.preventDefault()});
const apply=()=>{const at=read(),k=st.kv;ctl.forEach(([f,c,to])=>to(f==st.fig?k[c]:undefined));if(k.answers)answers(true);st.step=Math.min(2,Math.max(0,+k.step||0));if(st.slides&&!st.fig&&figs.length)st.fig=figs[0].id;show();const to=D.getElementById(st.fig||at);if(to&&!st.slides)to.scrollIntoView()};
addEventListener('hashchange',apply);apply();
// equations that do not fit get smaller
const fit=()=>$$('.eq').forEach(e=>{const m=$('.m',e);if(!m)return;m.style.fontSize='';const r=e.clientWidth/e.scrollWidth;if(r<1)m.style.fontSize=Math.max(50,98*r|0)+'%'});addEventListener('resize',fit);fit();
const nv=$$('.bar nav a'),io=new IntersectionObserver(es=>es.forEach(e=>{if(e.isIntersecting)nv.forEach(a=>{const on=a.hash=='#'+e.target.dataset.ch;a.classList.toggle('on',on);on?a.setAttribute('aria-current','true'):a.removeAttribute('aria-current')})}),{rootMargin:'-20% 0px -70%'});$$('[data-ch]').forEach(s=>io.observe(s));
})();
